/// Serial meshes as Gmsh would write them.
#pragma once

#include "gmsh/bodies.hpp"

#include <algorithm>
#include <map>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace tribogel::test
{

class GmshWriter
{
public:
  /// With hexahedra of 8, 20 or 27 nodes, on the bodies' shapes.
  GmshWriter(const SerialMesh &serial, Arrangement arrangement, int nodes) : mesh(serial), size(nodes)
  {
    X.resize(mesh.vertex.size());
    for (const SerialMesh::Cell &cell : mesh.cell)
      for (const int v : cell.vertex) X[v] = placed(cell.body, {v});
    for (const SerialMesh::Cell &cell : mesh.cell)
      add(3, cell.body + 1, cell.body, in_gmsh_order(cell.vertex));
    const auto groups = surface_groups(arrangement);
    for (const SerialMesh::Facet &facet : mesh.boundary)
      for (std::size_t g = 0; g < groups.size(); ++g)
        if (facet.side == groups[g].side)
          add(2, static_cast<int>(g) + 3, groups[g].body, around(facet.vertex));
    names = {"bottom", "top"};
    for (const SurfaceGroup &group : groups) names.push_back(group.name);
  }

  std::string format_2() const
  {
    std::ostringstream out;
    out.precision(17);
    out << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n" << physical_names() << "$Nodes\n" << X.size() << "\n";
    for (std::size_t n = 0; n < X.size(); ++n)
      out << n + 1 << " " << X[n][0] << " " << X[n][1] << " " << X[n][2] << "\n";
    out << "$EndNodes\n$Elements\n" << elements.size() << "\n";
    int tag = 0;
    for (const Element &element : elements)
      out << ++tag << " " << type_of(element) << " 2 " << element.group << " 7" << listed(element) << "\n";
    out << "$EndElements\n";
    return out.str();
  }

  /// One entity a group, numbered from 11 on; a comment, and sections that mean nothing here.
  std::string format_4() const
  {
    std::ostringstream out;
    out.precision(17);
    out << "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Comments\na word\n$EndComments\n" << physical_names();
    const auto surfaces = names.size() - 2;
    out << "$Entities\n1 1 " << surfaces << " 2\n5 0 0 0 0\n6 0 0 0 1 1 1 0 0\n";
    for (std::size_t g = 2; g < names.size(); ++g) out << 11 + g << " 0 0 0 1 1 1 1 " << g + 1 << " 0\n";
    for (std::size_t g = 0; g < 2; ++g) out << 11 + g << " 0 0 0 1 1 1 1 " << g + 1 << " 2 13 -14\n";
    out << "$EndEntities\n$Nodes\n1 " << X.size() << " 1 " << X.size() << "\n3 11 0 " << X.size() << "\n";
    for (std::size_t n = 0; n < X.size(); ++n) out << n + 1 << "\n";
    for (const auto &x : X) out << x[0] << " " << x[1] << " " << x[2] << "\n";
    out << "$EndNodes\n$Elements\n"
        << elements.size() << " " << elements.size() << " 1 " << elements.size() << "\n";
    int tag = 0;
    for (const Element &element : elements)
      out << (element.group < 3 ? 3 : 2) << " " << 10 + element.group << " " << type_of(element) << " 1\n"
          << ++tag << listed(element) << "\n";
    out << "$EndElements\n$Periodic\n0\n$EndPeriodic\n";
    return out.str();
  }

  /// As Gmsh writes a mesh that it has cut in two: each entity of format_4 as a parent of two, 100 and 200
  /// above it, which have its elements in turn; the faces between cells on entities under the volumes, with
  /// their groups' numbers. Surfaces are numbered from 1 on, as volumes are. `parts` says which of the two
  /// parts are written.
  std::string partitioned(const std::vector<int> &parts = {1, 2}) const
  {
    std::ostringstream out;
    out.precision(17);
    out << "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$PhysicalNames\n" << names.size() << "\n";
    const auto dim_of = [](std::size_t g) { return g < 2 ? 3 : 2; };
    const auto number_of = [](std::size_t g) { return g < 2 ? g + 1 : g - 1; };
    for (std::size_t g = 0; g < names.size(); ++g)
      out << dim_of(g) << " " << number_of(g) << " \"" << names[g] << "\"\n";
    const auto surfaces = names.size() - 2;
    const std::string box = " 0 0 0 1 1 1 ";
    out << "$EndPhysicalNames\n$Entities\n0 0 " << surfaces << " 2\n";
    for (std::size_t g = 2; g < names.size(); ++g) out << 11 + g << box << "1 -" << number_of(g) << " 0\n";
    for (std::size_t g = 0; g < 2; ++g) out << 11 + g << box << "1 " << number_of(g) << " 0\n";
    out << "$EndEntities\n$PartitionedEntities\n2\n1\n77 1\n0 1 " << 2 * surfaces + 2 << " 4\n";
    out << "88 2 13 2 1 2" << box << "0 0\n";
    const auto halves = [&](std::size_t g) {
      for (const int part : {1, 2})
        out << 11 + g + 100 * part << " " << dim_of(g) << " " << 11 + g << " 1 " << part << box
            << (part == 1 ? "1 " + std::to_string(number_of(g)) : "0")
            << " 0\n"; // the second has its parent's
    };
    for (std::size_t g = 2; g < names.size(); ++g) halves(g);
    for (std::size_t g = 0; g < 2; ++g)
      out << 301 + g << " 3 " << 11 + g << " 2 1 2" << box << "1 " << g + 1 << " 0\n";
    for (std::size_t g = 0; g < 2; ++g) halves(g);
    out << "$EndPartitionedEntities\n$Nodes\n1 " << X.size() << " 1 " << X.size() << "\n3 11 1 " << X.size()
        << "\n";
    for (std::size_t n = 0; n < X.size(); ++n) out << n + 1 << "\n";
    for (const auto &x : X)
      out << x[0] << " " << x[1] << " " << x[2] << " 0.1 0.2 0.3\n"; // on a parametric entity
    std::size_t count = 0;
    std::ostringstream blocks;
    for (std::size_t k = 0; k < elements.size(); ++k) {
      const Element &element = elements[k];
      const int part = static_cast<int>(k % 2) + 1, entity = 10 + element.group + 100 * part;
      if (std::find(parts.begin(), parts.end(), part) == parts.end()) continue;
      blocks << (element.group < 3 ? 3 : 2) << " " << entity << " " << type_of(element) << " 1\n"
             << k + 1 << listed(element) << "\n";
      ++count;
    }
    for (const auto &[body, face] : inner_faces()) {
      blocks << "2 " << 301 + body << " 3 1\n" << elements.size() + ++count << listed({3, face}) << "\n";
    }
    out << "$EndNodes\n$Elements\n" << count << " " << count << " 1 " << 2 * count << "\n" << blocks.str();
    out << "$EndElements\n$GhostElements\n1\n1 1 1 2\n$EndGhostElements\n";
    return out.str();
  }

private:
  struct Element {
    int group;
    std::vector<int> nodes; ///< from 0
  };

  std::array<double, 3> placed(int body, const std::vector<int> &vertices) const
  {
    std::array<double, 3> middle{};
    for (const int v : vertices)
      for (int i = 0; i < 3; ++i) middle[i] += mesh.vertex[v][i] / static_cast<double>(vertices.size());
    return mesh.shape[body] ? mesh.shape[body](middle) : middle;
  }

  static std::vector<int> in_gmsh_order(const std::array<int, 8> &v)
  {
    return {v[0], v[1], v[3], v[2], v[4], v[5], v[7], v[6]};
  }

  /// From a lexicographic facet.
  static std::vector<int> around(const std::array<int, 4> &v) { return {v[0], v[1], v[3], v[2]}; }

  /// Of the bodies: faces that two cells have, as corners around.
  std::vector<std::pair<int, std::vector<int>>> inner_faces() const
  {
    static constexpr int around_face[6][4] = {{0, 3, 2, 1}, {0, 1, 5, 4}, {0, 4, 7, 3},
                                              {1, 2, 6, 5}, {2, 3, 7, 6}, {4, 5, 6, 7}};
    std::map<std::array<int, 8>, int> cells_at;
    std::vector<std::pair<int, std::vector<int>>> faces;
    for (const SerialMesh::Cell &cell : mesh.cell)
      for (const auto &local : around_face) {
        const std::vector<int> corners = in_gmsh_order(cell.vertex);
        std::vector<int> face;
        for (const int k : local) face.push_back(corners[static_cast<std::size_t>(k)]);
        if (++cells_at[middle_key(face)] == 2) faces.emplace_back(cell.body, face);
      }
    return faces;
  }

  int middle(int body, const std::vector<int> &vertices)
  {
    const auto [place, is_new] = known.try_emplace(middle_key(vertices), static_cast<int>(X.size()));
    if (is_new) X.push_back(placed(body, vertices));
    return place->second;
  }

  void add(int dim, int group, int body, std::vector<int> v)
  {
    static const std::vector<std::vector<int>> edges[2] = {
        {{0, 1}, {1, 2}, {2, 3}, {3, 0}},
        {{0, 1}, {0, 3}, {0, 4}, {1, 2}, {1, 5}, {2, 3}, {2, 6}, {3, 7}, {4, 5}, {4, 7}, {5, 6}, {6, 7}}};
    static const std::vector<std::vector<int>> faces[2] = {
        {}, {{0, 3, 2, 1}, {0, 1, 5, 4}, {0, 4, 7, 3}, {1, 2, 6, 5}, {2, 3, 7, 6}, {4, 5, 6, 7}}};
    const std::vector<int> corners = v;
    const auto append = [&](const std::vector<int> &local) {
      std::vector<int> vertices;
      for (const int k : local) vertices.push_back(corners[k]);
      v.push_back(middle(body, vertices));
    };
    if (size > 8)
      for (const auto &edge : edges[dim - 2]) append(edge);
    if (size == 27) {
      for (const auto &face : faces[dim - 2]) append(face);
      v.push_back(middle(body, corners));
    }
    elements.push_back({group, v});
  }

  std::string physical_names() const
  {
    std::string out = "$PhysicalNames\n" + std::to_string(names.size()) + "\n";
    for (std::size_t g = 0; g < names.size(); ++g)
      out += std::string(g < 2 ? "3 " : "2 ") + std::to_string(g + 1) + " \"" + names[g] + "\"\n";
    return out + "$EndPhysicalNames\n";
  }

  static int type_of(const Element &element)
  {
    static const std::map<std::size_t, int> type{{4, 3}, {8, 16}, {9, 10}, {20, 17}, {27, 12}};
    return element.group < 3 && element.nodes.size() == 8 ? 5 : type.at(element.nodes.size());
  }

  static std::string listed(const Element &element)
  {
    std::ostringstream out;
    for (const int n : element.nodes) out << " " << n + 1;
    return out.str();
  }

  const SerialMesh &mesh;
  int size;
  std::vector<std::array<double, 3>> X;
  std::vector<Element> elements;
  std::vector<std::string> names;
  std::map<std::array<int, 8>, int> known;
};

} // namespace tribogel::test
