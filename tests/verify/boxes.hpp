/// Meshes of boxes.
#pragma once

#include "mesh/blocks.hpp"

#include <array>
#include <optional>
#include <vector>

namespace tribogel::test
{

/// A box, of the bottom body, with these levels along x, y and z. Its sides are named in the order x low, x
/// high, y low, y high, z low, z high.
struct Box {
  std::array<std::vector<double>, 3> levels;
  std::array<std::optional<Side>, 6> sides{};

  SerialMesh mesh() const
  {
    SerialMesh serial;
    serial.dim = 3;
    const std::array<int, 3> n{cells(0), cells(1), cells(2)};
    const auto vertex = [&](int i, int j, int k) { return i + (n[0] + 1) * (j + (n[1] + 1) * k); };
    for (const double z : levels[2])
      for (const double y : levels[1])
        for (const double x : levels[0]) serial.vertex.push_back({x, y, z});
    for (int k = 0; k < n[2]; ++k)
      for (int j = 0; j < n[1]; ++j)
        for (int i = 0; i < n[0]; ++i) {
          SerialMesh::Cell cell{{}, bottom_body, levels[0][i]};
          for (int v = 0; v < 8; ++v) cell.vertex[v] = vertex(i + v % 2, j + v / 2 % 2, k + v / 4);
          serial.cell.push_back(cell);
          for (int side = 0; side < 6; ++side) {
            const int axis = side / 2, at = std::array{i, j, k}[axis];
            if (!sides[side] || at != (side % 2 ? n[axis] - 1 : 0)) continue;
            SerialMesh::Facet facet{{}, *sides[side]};
            int next = 0;
            for (int v = 0; v < 8; ++v)
              if ((v >> axis & 1) == side % 2) facet.vertex[next++] = cell.vertex[v];
            serial.boundary.push_back(facet);
          }
        }
    return serial;
  }

private:
  int cells(int axis) const { return static_cast<int>(levels[axis].size()) - 1; }
};

/// Both boxes as one mesh, the second one the top body.
inline SerialMesh stacked(const Box &lower, const Box &upper)
{
  SerialMesh mesh = lower.mesh();
  const SerialMesh top = upper.mesh();
  const auto shift = static_cast<int>(mesh.vertex.size());
  mesh.vertex.insert(mesh.vertex.end(), top.vertex.begin(), top.vertex.end());
  for (SerialMesh::Cell cell : top.cell) {
    for (int &v : cell.vertex) v += shift;
    cell.body = top_body;
    mesh.cell.push_back(cell);
  }
  for (SerialMesh::Facet facet : top.boundary) {
    for (int &v : facet.vertex) v += shift;
    mesh.boundary.push_back(facet);
  }
  return mesh;
}

inline std::vector<double> even(double a, double b, int cells)
{
  std::vector<double> levels;
  for (int k = 0; k <= cells; ++k) levels.push_back(a + (b - a) * k / cells);
  return levels;
}

} // namespace tribogel::test
