#include "gmsh/hexahedron.hpp"

#include "tribogel/element/quadrature.hpp"
#include "tribogel/element/shape.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace tribogel
{

namespace
{

/// The least that a cell may have of the volume its three edges at a point would span if they were at right
/// angles. It tells what is flat from what is round-off of a file's digits.
constexpr double least_volume = 1e-6;

/// How far a middle may lie from where the other nodes put it, over the length of the longest edge there:
/// that of an edge as far as in half a circle, but along the edge less, where a quarter makes the cell
/// degenerate at its end; those of faces and cells by half of what an edge bulges in a quarter of a circle.
constexpr double edge_bulge = 0.5, along_edge = 0.2, off_centre = 0.125;

/// Where Gmsh's nodes are among the lexicographic ones of a cell with so many nodes an edge.
template <int order> std::array<int, tensor_nodes<3, order>> slots()
{
  constexpr int stride[3] = {1, order + 1, (order + 1) * (order + 1)};
  std::array<int, tensor_nodes<3, order>> slot;
  for (int k = 0; k < tensor_nodes<3, order>; ++k) {
    const std::vector<int> corners = corners_of_node(k);
    slot[k] = 0;
    for (const int corner : corners) {
      const int lexicographic = gmsh_corner[corner]; // its own inverse
      for (int j = 0; j < 3; ++j) slot[k] += (lexicographic >> j & 1) * stride[j] * order;
    }
    slot[k] /= static_cast<int>(corners.size());
  }
  return slot;
}

/// Shape functions in Gmsh's order of nodes, and their slopes.
template <int order> struct Sample {
  std::array<double, tensor_nodes<3, order>> value;
  std::array<std::array<double, 3>, tensor_nodes<3, order>> slope;
};

/// Where a map of this order is judged: at its nodes, the corners first, and where elements of order
/// `quadrature` integrate.
template <int order, int quadrature> std::vector<Sample<order>> samples()
{
  constexpr int nodes = tensor_nodes<3, order>, n = order + 1, m = quadrature + 1;
  const auto gauss = gauss_rule<m>();
  const auto slot = slots<order>();
  std::vector<Sample<order>> all;
  const auto add = [&](const std::array<double, 3> &xi) {
    const auto shape = tensor_shape<3, order>(xi);
    Sample<order> sample;
    for (int k = 0; k < nodes; ++k) {
      sample.value[k] = shape.N[slot[k]];
      sample.slope[k] = shape.dN[slot[k]];
    }
    all.push_back(sample);
  };
  const auto level = [](int k) { return 2. * k / order - 1; };
  for (const int s : slot) add({level(s % n), level(s / n % n), level(s / (n * n))});
  for (int k = 0; k < m * m * m; ++k)
    add({gauss.point[k % m], gauss.point[k / m % m], gauss.point[k / m / m]});
  return all;
}

/// The volume that the map's three slopes span over the product of their lengths.
template <int order> double volume(const std::array<Place, 27> &node, const Sample<order> &at)
{
  double J[3][3] = {};
  for (std::size_t k = 0; k < at.slope.size(); ++k)
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 3; ++i) J[j][i] += at.slope[k][j] * node[k][i];
  double determinant = 0, lengths = 1;
  for (int i = 0; i < 3; ++i) {
    const int k = (i + 1) % 3, l = (i + 2) % 3;
    determinant += J[0][i] * (J[1][k] * J[2][l] - J[1][l] * J[2][k]);
    lengths *= std::sqrt(J[i][0] * J[i][0] + J[i][1] * J[i][1] + J[i][2] * J[i][2]);
  }
  return determinant / lengths;
}

/// Where the map is flat or turned inside out.
template <int order, int quadrature> std::optional<Place> fold(const std::array<Place, 27> &node)
{
  static const auto judged = samples<order, quadrature>();
  const double sign = is_left_handed(node) ? -1 : 1;
  for (const auto &sample : judged)
    if (!(sign * volume(node, sample) > least_volume)) {
      Place X{};
      for (std::size_t k = 0; k < sample.value.size(); ++k)
        for (int i = 0; i < 3; ++i) X[i] += sample.value[k] * node[k][i];
      return X;
    }
  return {};
}

/// Corners by -1/4, edges by `weight`: 1/2 in a face, 1/4 in the cell.
Place blend(const std::array<Place, 27> &node, const std::vector<int> &corners, double weight)
{
  Place X{};
  const auto has = [&](int v) { return std::find(corners.begin(), corners.end(), v) != corners.end(); };
  const auto add = [&X](double w, const Place &x) {
    for (int i = 0; i < 3; ++i) X[i] += w * x[i];
  };
  for (const int v : corners) add(-0.25, node[v]);
  for (int e = 0; e < 12; ++e)
    if (has(gmsh_edge[e][0]) && has(gmsh_edge[e][1])) add(weight, node[8 + e]);
  return X;
}

Place mean(const std::array<Place, 27> &node, const std::vector<int> &corners)
{
  Place X{};
  for (const int v : corners)
    for (int i = 0; i < 3; ++i) X[i] += node[v][i] / static_cast<double>(corners.size());
  return X;
}

/// What the other nodes make of it: the middle of an edge from its ends, those of faces and the cell from
/// edges.
Place expected_place(const std::array<Place, 27> &node, int k)
{
  const std::vector<int> corners = corners_of_node(k);
  return k < 20 ? mean(node, corners) : blend(node, corners, k < 26 ? 0.5 : 0.25);
}

/// How far it is from there, over how far it may be.
double excess(const std::array<Place, 27> &node, int k)
{
  const std::vector<int> corners = corners_of_node(k);
  const Place expected = expected_place(node, k);
  const double off = distance(node[k], expected);
  double longest = 0;
  for (const auto &[a, b] : gmsh_edge)
    if (std::count(corners.begin(), corners.end(), a) && std::count(corners.begin(), corners.end(), b))
      longest = std::max(longest, distance(node[a], node[b]));
  if (k >= 20) return off / longest / off_centre;
  double along = 0;
  for (int i = 0; i < 3; ++i)
    along += (node[k][i] - expected[i]) * (node[corners[1]][i] - node[corners[0]][i]) / longest;
  return std::max(off / edge_bulge, std::abs(along) / along_edge) / longest;
}

/// Whose order of middles puts all of them near the middles of their edges; empty: nobody's.
std::string order_of_another(const std::array<Place, 27> &node)
{
  struct Order {
    const char *programs;
    int edge[12][2];
  };
  static constexpr Order others[] = {
      {"Abaqus, CalculiX, Ansys and VTK",
       {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6}, {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}}},
      {"Exodus, Nastran and libMesh",
       {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 4}, {1, 5}, {2, 6}, {3, 7}, {4, 5}, {5, 6}, {6, 7}, {7, 4}}}};
  for (const Order &order : others) {
    bool near = true;
    for (int e = 0; e < 12; ++e) {
      const auto &[a, b] = order.edge[e];
      near = near && distance(node[8 + e], mean(node, {a, b})) < edge_bulge / 2 * distance(node[a], node[b]);
    }
    if (near) return order.programs;
  }
  return {};
}

/// "the middle of an edge at (1, 2, 3), 0.4 mm from (1, 2, 3.4), where its other nodes put it".
std::string place_of_middle(const std::array<Place, 27> &node, int k)
{
  const Place expected = expected_place(node, k);
  return std::string("the middle of ") +
         (k < 20   ? "an edge"
          : k < 26 ? "a face"
                   : "the cell") +
         " at " + in_words(node[k]) + ", " + five_digits(distance(node[k], expected)) + " mm from " +
         in_words(expected) + ", where its other nodes put it";
}

} // namespace

std::vector<int> corners_of_node(int node)
{
  if (node < 8) return {node};
  if (node < 20) return {gmsh_edge[node - 8], gmsh_edge[node - 8] + 2};
  if (node < 26) return {gmsh_face[node - 20], gmsh_face[node - 20] + 4};
  return {0, 1, 2, 3, 4, 5, 6, 7};
}

std::array<Place, 27> all_nodes(const std::vector<Place> &given)
{
  std::array<Place, 27> node;
  std::copy(given.begin(), given.end(), node.begin());
  for (auto k = static_cast<int>(given.size()); k < 27; ++k)
    node[k] = given.size() == 8 ? mean(node, corners_of_node(k)) : expected_place(node, k);
  return node;
}

bool is_left_handed(const std::array<Place, 27> &node)
{
  static const auto judged = samples<1, 1>();
  return volume(node, judged.front()) < 0;
}

std::string fault_of(const std::array<Place, 27> &node, std::size_t given, int order)
{
  const auto at = order == 1 ? fold<1, 1>(node) : fold<1, 2>(node);
  if (at) return "is degenerate or folded at " + in_words(*at) + "; allowed: convex hexahedra";
  if (order == 1 || given == 8) return {};
  const auto farthest = [&](int from, int to) {
    int k = from;
    for (int other = from; other < to; ++other)
      if (excess(node, other) > excess(node, k)) k = other;
    return k;
  };
  const int edge = farthest(8, 20),
            centre = farthest(20, 27); // where centres are expected depends on the edges
  const std::string allowed =
      "; allowed: nodes in Gmsh's order, each middle near the middle (-element_order 1 takes "
      "the corners only)";
  for (const int k : {edge, centre})
    if (excess(node, k) > 1) {
      const std::string programs = order_of_another(node);
      return "has " + place_of_middle(node, k) +
             (programs.empty() ? "" : "; its nodes look like those in the order of " + programs) + allowed;
    }
  if (const auto curved = fold<2, 2>(node))
    return "is degenerate or folded at " + in_words(*curved) +
           " with its middles, of which the farthest off is " + place_of_middle(node, edge) + allowed;
  return {};
}

std::string in_words(const Place &X)
{
  double size = 0;
  for (const double x : X) size = std::max(size, std::abs(x));
  std::string text;
  for (const double x : X)
    text += (text.empty() ? "(" : ", ") + five_digits(std::abs(x) < 1e-9 * size ? 0 : x); // round-off
  return text + ")";
}

std::string five_digits(double value)
{
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%.5g", value + 0.); // no -0
  return buffer;
}

std::string in_number(std::size_t count)
{
  return count == 1 ? "" : std::to_string(count) + ", e.g. ";
}

double distance(const Place &a, const Place &b)
{
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

} // namespace tribogel
