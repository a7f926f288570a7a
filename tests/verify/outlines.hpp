/// Outlines that no option gives: large blocks in the place of half-spaces, a spherical cap, a ring.
#pragma once

#include "bulk_scenes.hpp"

#include <limits>

namespace tribogel::test
{

/// Edges of length h from 0 to `even`, then longer by `ratio` from one to the next, up to `end`; all halved `halvings`
/// times, so that the meshes are nested.
inline std::vector<double> graded_outwards(double even, double h, double end, double ratio, int halvings)
{
  std::vector<double> points = graded_points(0, even, false, false, h, 1, h);
  const auto outer = graded_points(even, end, true, false, h * ratio, ratio, std::numeric_limits<double>::infinity());
  points.insert(points.end(), outer.begin() + 1, outer.end());
  for (int k = 0; k < halvings; ++k) {
    std::vector<double> finer{points[0]};
    for (std::size_t i = 0; i + 1 < points.size(); ++i)
      finer.insert(finer.end(), {0.5 * (points[i] + points[i + 1]), points[i + 1]});
    points = finer;
  }
  return points;
}

/// The points seen from below: those from -end to 0.
inline std::vector<double> downwards(std::vector<double> points)
{
  std::reverse(points.begin(), points.end());
  for (double &z : points) z = -z;
  return points;
}

/// A body with the axis as its inner side, bonded to the bottom plate, its upper face at Z = 0.
inline MeridianBlock lower_body(const std::vector<double> &R, const std::vector<double> &depth)
{
  return {bottom_body, R, downwards(depth), Side::axis, Side::wall, Side::bottom_plate, Side::master};
}

/// The same turned over: bonded to the top plate, its lower face at Z = 0.
inline MeridianBlock upper_body(const std::vector<double> &R, const std::vector<double> &height)
{
  return {top_body, R, height, Side::axis, Side::wall, Side::slave, Side::top_plate};
}

/// An upper body whose lower face is the bottom of a sphere that touches Z = 0; its plate stays plane.
inline MeridianBlock spherical_cap(double sphere, const std::vector<double> &R, const std::vector<double> &height)
{
  MeridianBlock cap = upper_body(R, height);
  cap.shape = [sphere, top = height.back()](double r, double z) {
    const double rise = r * r / (sphere + std::sqrt(sphere * sphere - r * r));
    return std::array{r, z + rise * (1 - z / top)};
  };
  return cap;
}

/// Small-strain constants of a hyperelastic gel [MPa, 1].
struct Elastic {
  double G, nu;

  explicit Elastic(const Ogden<double> &law) : G(law.shear_modulus())
  {
    const double K = law.bulk_modulus;
    nu = (3 * K - 2 * G) / (2 * (3 * K + G));
  }
  double young() const { return 2 * G * (1 + nu); }
  double plane() const { return 2 * G / (1 - nu); } ///< E/(1 - nu^2)
};

} // namespace tribogel::test
