#include "mesh/digest.hpp"

#include <bit>
#include <cstdint>
#include <cstdio>

namespace tribogel
{

namespace
{

/// FNV-1a of 64 bits. It tells meshes apart that differ by mistake; nobody makes two of the same digest on
/// purpose.
class Fnv
{
public:
  void add(std::uint64_t word)
  {
    for (int shift = 0; shift < 64; shift += 8) {
      sum ^= word >> shift & 0xFF;
      sum *= 1099511628211u;
    }
  }
  void add(int number) { add(static_cast<std::uint64_t>(number)); }
  void add(double x) { add(std::bit_cast<std::uint64_t>(x == 0 ? 0.0 : x)); } // -0 is 0
  std::uint64_t value() const { return sum; }

private:
  std::uint64_t sum = 14695981039346656037u;
};

} // namespace

std::string digest_of(const SerialMesh &mesh, bool places)
{
  Fnv fnv;
  for (const std::size_t size :
       {mesh.vertex.size(), mesh.cell.size(), mesh.boundary.size(), mesh.middle.size()})
    fnv.add(static_cast<std::uint64_t>(size));
  for (const SerialMesh::Cell &cell : mesh.cell) {
    fnv.add(cell.body);
    for (int v = 0; v < mesh.corners(); ++v) fnv.add(cell.vertex[static_cast<std::size_t>(v)]);
  }
  for (const SerialMesh::Facet &facet : mesh.boundary) {
    fnv.add(static_cast<int>(facet.side));
    for (int v = 0; v < mesh.facet_corners(); ++v) fnv.add(facet.vertex[static_cast<std::size_t>(v)]);
  }
  for (const auto &[key, X] : mesh.middle)
    for (const int v : key) fnv.add(v);
  if (places) {
    for (const auto &X : mesh.vertex)
      for (const double x : X) fnv.add(x);
    for (const auto &[key, X] : mesh.middle)
      for (const double x : X) fnv.add(x);
  }
  char text[17];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(fnv.value()));
  return text;
}

} // namespace tribogel
