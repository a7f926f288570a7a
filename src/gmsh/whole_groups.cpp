/// Faces that are missing from the groups of plates and contact faces.
#include "gmsh/checks.hpp"
#include "gmsh/outer_face.hpp"
#include "support/user_error.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace tribogel
{

namespace
{

/// How far a face may be from a plane that it is meant to lie in, as a part of its size, and as an angle.
constexpr double in_plane = 1e-3;

/// The least cosine between a face's normal and the direction in which it looks: sixty degrees.
constexpr double looks = 0.5;

/// A side of a body that has a group, as it looks along z.
struct Group {
  const char *name;
  Side side;
  int body;
  double direction; ///< of its outward normals: 1 or -1
};

class Examination
{
public:
  Examination(GmshBodies &given, double down) : bodies(given), mesh(given.mesh), travel(down)
  {
    for (const OuterFace &face : bodies.outer) normals.push_back(area_vector(mesh, face));
  }

  void plate(const Group &group)
  {
    const auto [low, high] = heights(group.side);
    std::vector<std::size_t> missing;
    for (std::size_t f = 0; f < bodies.outer.size(); ++f) {
      if (!is_free(f, group)) continue;
      const double tolerance = in_plane * size(f);
      const auto [lowest, highest] = heights(f);
      if (lowest >= low - tolerance && highest <= high + tolerance) missing.push_back(f);
    }
    judge(group, missing, "lie in its plane", "the plate does not hold them");
  }

  /// `other` is the side that it meets; a bottom plate is the plane z = 0.
  void contact(const Group &group, Side other)
  {
    const bool on_plane = other == Side::bottom_plate; // z = 0, without end
    const double reach = on_plane ? std::numeric_limits<double>::infinity() : radius(other);
    const auto [lowest_of_other, highest_of_other] = on_plane ? std::array{0.0, 0.0} : heights(other);
    std::vector<std::size_t> certain, suspicious;
    const std::vector<bool> goes_on = continuations(group);
    for (std::size_t f = 0; f < bodies.outer.size(); ++f) {
      if (!is_free(f, group)) continue;
      const Place centre = on_face(mesh, bodies.outer[f], 0.5, 0.5);
      const auto [lowest, highest] = heights(f);
      const double gap = group.direction < 0 ? lowest - highest_of_other : lowest_of_other - highest;
      if (goes_on[f] && std::hypot(centre[0], centre[1]) < reach)
        certain.push_back(f);
      else if (bodies.outer[f].other_group.empty() && gap < travel && nearest(f) < reach + travel)
        suspicious.push_back(f);
    }
    judge(group, certain, "go on where its faces end", "they meet nothing");
    if (!suspicious.empty())
      bodies.warnings.push_back(found(group, suspicious) +
                                " look at what the gel is pressed on, which may come as near as that" +
                                consequence("they meet nothing") + in_words_allowed(group));
  }

private:
  double size(std::size_t f) const { return std::sqrt(length(normals[f])); }

  /// In no group, and looking where the group does.
  bool is_free(std::size_t f, const Group &group) const
  {
    const OuterFace &face = bodies.outer[f];
    return !face.named && mesh.cell[face.cell].body == group.body &&
           normals[f][2] * group.direction > looks * length(normals[f]);
  }

  /// Lowest and highest vertex.
  std::array<double, 2> heights(std::size_t f) const
  {
    std::array<double, 2> z{std::numeric_limits<double>::infinity(),
                            -std::numeric_limits<double>::infinity()};
    for (const int v : bodies.outer[f].around) {
      z[0] = std::min(z[0], mesh.vertex[v][2]);
      z[1] = std::max(z[1], mesh.vertex[v][2]);
    }
    return z;
  }

  std::array<double, 2> heights(Side side) const
  {
    std::array<double, 2> z{std::numeric_limits<double>::infinity(),
                            -std::numeric_limits<double>::infinity()};
    for (std::size_t f = 0; f < bodies.outer.size(); ++f)
      if (bodies.outer[f].side == side) {
        const auto [low, high] = heights(f);
        z[0] = std::min(z[0], low);
        z[1] = std::max(z[1], high);
      }
    return z;
  }

  /// Of the vertices, about the plates' axis: what turns sweeps a disc.
  double radius(Side side) const
  {
    double R = 0;
    for (const OuterFace &face : bodies.outer)
      if (face.side == side)
        for (const int v : face.around) R = std::max(R, std::hypot(mesh.vertex[v][0], mesh.vertex[v][1]));
    return R;
  }

  double nearest(std::size_t f) const
  {
    double r = std::numeric_limits<double>::infinity();
    for (const int v : bodies.outer[f].around)
      r = std::min(r, std::hypot(mesh.vertex[v][0], mesh.vertex[v][1]));
    return r;
  }

  using Edges =
      std::map<std::array<int, 2>, std::vector<std::size_t>>; ///< outer faces of each edge of the body

  Edges edges_of(int body) const
  {
    Edges edges;
    for (std::size_t f = 0; f < bodies.outer.size(); ++f)
      if (mesh.cell[bodies.outer[f].cell].body == body)
        for (const auto &edge : edges_around(f)) edges[edge].push_back(f);
    return edges;
  }

  std::array<std::array<int, 2>, 4> edges_around(std::size_t f) const
  {
    std::array<std::array<int, 2>, 4> edges;
    for (int v = 0; v < 4; ++v) {
      const int a = bodies.outer[f].around[v], b = bodies.outer[f].around[(v + 1) % 4];
      edges[v] = {std::min(a, b), std::max(a, b)};
    }
    return edges;
  }

  /// Free faces that lie in one plane with a face of the group and are joined to it by such, and those that
  /// faces of the group surround.
  std::vector<bool> continuations(const Group &group) const
  {
    const Edges edges = edges_of(group.body);
    std::vector<bool> result(bodies.outer.size(), false), seen = result;
    const auto spread = [&](std::size_t from, auto &&enter) {
      std::vector<std::size_t> rest{from};
      while (!rest.empty()) {
        const std::size_t f = rest.back();
        rest.pop_back();
        for (const auto &edge : edges_around(f))
          for (const std::size_t next : edges.at(edge))
            if (next != f && enter(next)) rest.push_back(next);
      }
    };
    for (std::size_t f = 0; f < bodies.outer.size(); ++f)
      if (bodies.outer[f].side == group.side)
        spread(f, [&](std::size_t next) {
          const bool enters = !result[next] && is_free(next, group) && in_one_plane(f, next);
          if (enters) result[next] = true;
          return enters;
        });
    for (std::size_t f = 0; f < bodies.outer.size(); ++f) {
      if (seen[f] || !is_free(f, group)) continue;
      std::vector<std::size_t> island{f};
      bool surrounded = true;
      seen[f] = true;
      spread(f, [&](std::size_t next) {
        const bool enters = !seen[next] && is_free(next, group);
        if (!is_free(next, group)) surrounded = surrounded && bodies.outer[next].side == group.side;
        if (enters) {
          seen[next] = true;
          island.push_back(next);
        }
        return enters;
      });
      if (surrounded)
        for (const std::size_t k : island) result[k] = true;
    }
    return result;
  }

  bool in_one_plane(std::size_t f, std::size_t g) const
  {
    const Place n = plus({}, 1 / length(normals[f]), normals[f]),
                m = plus({}, 1 / length(normals[g]), normals[g]);
    const Place offset =
        plus(on_face(mesh, bodies.outer[g], 0.5, 0.5), -1, on_face(mesh, bodies.outer[f], 0.5, 0.5));
    return length(plus(n, -1, m)) < in_plane &&
           std::abs(n[0] * offset[0] + n[1] * offset[1] + n[2] * offset[2]) <
               in_plane * std::max(size(f), size(g));
  }

  /// "faces of top with 12 mm^2, 20 % of what top_contact and they are, (4, e.g. that of element 7 at (1, 2,
  /// 3))".
  std::string found(const Group &group, const std::vector<std::size_t> &faces) const
  {
    double area = 0, named = 0;
    for (const std::size_t f : faces) area += length(normals[f]);
    for (std::size_t f = 0; f < bodies.outer.size(); ++f)
      if (bodies.outer[f].side == group.side) named += length(normals[f]);
    return std::string(group.name) + " lacks faces of " + body_names[group.body] + ": " + five_digits(area) +
           " mm^2, " + five_digits(std::round(1000 * area / (area + named)) / 10) +
           " % of the area with them (" + in_number(faces.size()) +
           example(bodies, bodies.outer[faces.front()]) + "),";
  }

  static std::string consequence(const std::string &what) { return "; as it is, " + what; }

  static std::string in_words_allowed(const Group &group)
  {
    return std::string("; allowed: in ") + group.name +
           ", or, if they are meant to be free, in a physical surface of any other name";
  }

  /// What belongs to the group but is not in it: refused, or warned of where the file calls it something
  /// else.
  void judge(const Group &group, const std::vector<std::size_t> &faces, const std::string &why,
             const std::string &what)
  {
    std::vector<std::size_t> nameless, meant;
    for (const std::size_t f : faces) (bodies.outer[f].other_group.empty() ? nameless : meant).push_back(f);
    if (!nameless.empty())
      throw UserError{found(group, nameless) + " which " + why + " and are in no physical surface" +
                      consequence(what) + in_words_allowed(group)};
    if (!meant.empty())
      bodies.warnings.push_back(found(group, meant) + " which " + why + " but are in the physical surface '" +
                                bodies.outer[meant.front()].other_group + "'" + consequence(what));
  }

  GmshBodies &bodies;
  const SerialMesh &mesh;
  double travel;
  std::vector<Place> normals; ///< of the outer faces, as long as their areas
};

} // namespace

void expect_whole_groups(GmshBodies &bodies, Arrangement arrangement, double travel)
{
  Examination examination(bodies, travel);
  for (const SurfaceGroup &group : surface_groups(arrangement))
    if (group.side == Side::bottom_plate || group.side == Side::top_plate)
      examination.plate({group.name, group.side, group.body, group.side == Side::top_plate ? 1.0 : -1.0});
  if (arrangement == Arrangement::single_gel) return;
  const bool on_gel = arrangement == Arrangement::gel_on_gel;
  if (on_gel) examination.contact({"bottom_contact", Side::master, bottom_body, 1}, Side::slave);
  examination.contact({"top_contact", Side::slave, top_body, -1}, on_gel ? Side::master : Side::bottom_plate);
}

} // namespace tribogel
