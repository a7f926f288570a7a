#include "gmsh/mesh_file.hpp"

#include "gmsh/bodies.hpp"
#include "gmsh/checks.hpp"
#include "mesh/cylinder.hpp"
#include "mesh/face.hpp"
#include "options/discretisation_options.hpp"
#include "options/sizes.hpp"
#include "support/first_process.hpp"
#include "support/parse.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <numbers>
#include <type_traits>

namespace tribogel
{

namespace
{

/// How far from a plane or from z = 0 a node may lie that is meant to be there, over the height: files have
/// few digits.
constexpr double flat = 1e-6;

using Place = std::array<double, 3>;

/// The nodes of a face that elements of order 2 see, lexicographic.
std::array<Place, 9> nodes_of(const SerialMesh &mesh, const std::array<int, 4> &around)
{
  const auto at = [&](const std::vector<int> &vertices) {
    if (const auto found = mesh.middle.find(middle_key(vertices)); found != mesh.middle.end())
      return found->second;
    Place mean{};
    for (const int v : vertices)
      for (int i = 0; i < 3; ++i) mean[i] += mesh.vertex[v][i] / static_cast<double>(vertices.size());
    return mean;
  };
  const auto [a, b, c, d] = around;
  return {at({a}),    at({a, b}), at({b}),    at({a, d}), at({a, b, c, d}),
          at({b, c}), at({d}),    at({c, d}), at({c})};
}

struct Extent {
  double low = std::numeric_limits<double>::infinity(), high = -low, area = 0;
  std::array<double, 2> moment{};                ///< integral of x, y
  std::vector<std::array<double, 2>> nodes = {}; ///< x, y

  std::array<double, 2> centroid() const { return {moment[0] / area, moment[1] / area}; }

  /// Whether x = y = 0 lies in the nodes' convex hull: seen from there, no half plane is empty.
  bool around_axis() const
  {
    std::vector<double> angles;
    for (const auto &x : nodes) {
      if (x[0] == 0 && x[1] == 0) return true;
      angles.push_back(std::atan2(x[1], x[0]));
    }
    std::sort(angles.begin(), angles.end());
    double widest = angles.front() + 2 * std::numbers::pi - angles.back();
    for (std::size_t k = 1; k < angles.size(); ++k) widest = std::max(widest, angles[k] - angles[k - 1]);
    return widest < std::numbers::pi * (1 + flat);
  }
};

double height_of(const SerialMesh &mesh, int body)
{
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const SerialMesh::Cell &cell : mesh.cell)
    if (cell.body == body)
      for (const int v : cell.vertex) {
        low = std::min(low, mesh.vertex[v][2]);
        high = std::max(high, mesh.vertex[v][2]);
      }
  return high - low;
}

void measure_bottom(const Extent &upper, const char *upper_name, const Extent &lower, SpecimenSizes &sizes)
{
  if (std::abs(upper.high) > flat * std::abs(upper.high - lower.low))
    throw UserError{std::string(upper_name) + " has its highest point at z = " + to_text(upper.high) +
                    " mm; allowed: z = 0 (lengths in mm, the plates' axis is x = y = 0)"};
  if (!(lower.high < 0))
    throw UserError{"bottom_plate at z = " + to_text(lower.high) + " mm; allowed: z < 0, below the gel"};
  sizes.height[bottom_body] = -lower.low;
  sizes.radius[bottom_body] = std::sqrt(upper.area / std::numbers::pi);
  sizes.centroid[bottom_body] = upper.centroid();
  sizes.around_axis[bottom_body] = upper.around_axis();
}

/// Heights, and whether the faces are where they have to be.
SpecimenSizes measure(const SerialMesh &mesh, Arrangement arrangement)
{
  SpecimenSizes sizes;
  Extent extent[side_count];
  for (const SerialMesh::Facet &facet : mesh.boundary) {
    Extent &side = extent[static_cast<int>(facet.side)];
    const auto nodes = nodes_of(mesh, facet.vertex);
    std::vector<FaceSample> samples;
    add_samples(nodes, samples);
    for (const FaceSample &sample : samples) {
      side.area += sample.area;
      for (int i = 0; i < 2; ++i) side.moment[i] += sample.area * sample.X[i];
    }
    for (const Place &X : nodes) {
      side.low = std::min(side.low, X[2]);
      side.high = std::max(side.high, X[2]);
      side.nodes.push_back({X[0], X[1]});
    }
  }
  const auto of = [&](Side side) -> const Extent & { return extent[static_cast<int>(side)]; };
  for (const SurfaceGroup &group : surface_groups(arrangement)) {
    const Extent &side = of(group.side);
    if (group.side != Side::top_plate && group.side != Side::bottom_plate) continue;
    if (side.high - side.low > flat * height_of(mesh, group.body))
      throw UserError{std::string(group.name) + " reaches from z = " + to_text(side.low) + " mm to " +
                      to_text(side.high) + " mm; allowed: a horizontal plane, the plate is one"};
  }
  const Extent *upper = nullptr; // of the bottom gel
  if (arrangement != Arrangement::gel_on_rigid) {
    const bool below_other = arrangement == Arrangement::gel_on_gel;
    upper = &of(below_other ? Side::master : Side::top_plate);
    measure_bottom(*upper, below_other ? "bottom_contact" : "top_plate", of(Side::bottom_plate), sizes);
  }
  if (arrangement == Arrangement::single_gel) return sizes;
  const Extent &slave = of(Side::slave);
  if (slave.low < -flat * std::abs(of(Side::top_plate).low))
    throw UserError{"top_contact has its lowest point at z = " + to_text(slave.low) +
                    " mm; allowed: z >= 0, above " + (upper ? "bottom_contact" : "the rigid plane z = 0")};
  if (!(of(Side::top_plate).low > slave.high))
    throw UserError{"top_plate at z = " + to_text(of(Side::top_plate).low) +
                    " mm; allowed: above top_contact"};
  sizes.gap = std::max(0.0, slave.low);
  sizes.height[top_body] = of(Side::top_plate).low - sizes.gap;
  sizes.radius[top_body] = std::sqrt(slave.area / std::numbers::pi);
  sizes.centroid[top_body] = slave.centroid();
  sizes.around_axis[top_body] = slave.around_axis();
  sizes.unevenness = slave.high - slave.low + (upper ? upper->high - upper->low : 0);
  return sizes;
}

/// Reads the file; adds to the warnings; a complaint in words, empty if all is well.
std::string read_file(SceneInput &input, SerialMesh &mesh, SpecimenSizes &sizes)
{
  const std::string &path = input.mesh_file;
  const Scene &scene = input.scene;
  std::error_code ignored;
  const std::string file = "-mesh_file = " + path + ": ";
  if (!std::filesystem::exists(path, ignored))
    return file + "does not exist; allowed: " +
           (input.output.restart ? "with -restart, -mesh_file with the path that the mesh of that run has now"
                                 : "a Gmsh file, its path relative to the working directory");
  if (!std::filesystem::is_regular_file(path, ignored))
    return file + "is no regular file; allowed: a Gmsh file";
  std::ifstream stream(path);
  if (!stream) return file + "cannot be read; allowed: a Gmsh file";
  try {
    double travel = 0;
    for (const Phase &phase : scene.schedule) travel = std::max(travel, phase.end_approach);
    GmshBodies bodies = bodies_of_gmsh(stream, scene.arrangement, scene.mesh.element_order);
    const std::vector<Touch> touches = touches_of(bodies);
    expect_joined(bodies, touches);
    expect_held(bodies, scene.arrangement);
    sizes = measure(bodies.mesh, scene.arrangement);
    expect_whole_groups(bodies, scene.arrangement, travel);
    expect_apart(bodies, touches);
    for (const std::string &warning : bodies.warnings) input.warnings.push_back(file + warning);
    mesh = std::move(bodies.mesh);
  } catch (const UserError &error) {
    return file + error.text;
  }
  if (static_cast<double>(mesh.cell.size()) > most_elements(scene))
    return file + std::to_string(mesh.cell.size()) + " hexahedra; allowed: at most " +
           to_text(most_elements(scene)) + " (matrix positions are 32-bit numbers)";
  return {};
}

} // namespace

PetscErrorCode MakeMesh(MPI_Comm comm, SceneInput &input, SerialMesh &mesh)
{
  Scene &scene = input.scene;
  SpecimenSizes sizes;
  PetscFunctionBeginUser;
  if (input.mesh_file.empty()) {
    mesh = mesh_of(scene.model, meridian_blocks(scene));
    PetscFunctionReturn(0);
  }
  PetscCall(OnFirstProcess(comm, [&] { return read_file(input, mesh, sizes); }));
  static_assert(std::is_trivially_copyable_v<SpecimenSizes>);
  PetscCallMPI(MPI_Bcast(&sizes, sizeof sizes, MPI_BYTE, 0, comm)); // the same program on all
  take_sizes(input, sizes);
  mesh.dim = 3;
  PetscFunctionReturn(0);
}

} // namespace tribogel
