/// Outlines that no option gives: large blocks in the place of half-spaces, a spherical cap, a ring.
#pragma once

#include "bulk_scenes.hpp"

#include <cmath>

namespace tribogel::test
{

/// Points from a to b, equally spaced by at most h.
inline std::vector<double> equal_points(double a, double b, double h)
{
  const auto count = static_cast<int>(std::ceil((b - a) / h - 1e-9));
  std::vector<double> points{a};
  for (int k = 1; k < count; ++k) points.push_back(a + (b - a) * k / count);
  points.push_back(b);
  return points;
}

/// Points from a to b whose edges start with `first` and grow by `ratio`, scaled to fit. A last edge that
/// would be covered to less than half is not added.
inline std::vector<double> growing_points(double a, double b, double first, double ratio)
{
  std::vector<double> sizes, points{a};
  double sum = 0;
  for (double edge = first; sizes.empty() || sum + 0.5 * edge < b - a; edge *= ratio) {
    sizes.push_back(edge);
    sum += edge;
  }
  for (const double edge : sizes) points.push_back(points.back() + edge * (b - a) / sum);
  points.back() = b;
  return points;
}

/// Edges of length h from 0 to `even`, then longer by `ratio` from one to the next, up to `end`; all halved
/// `halvings` times, so that the meshes are nested.
inline std::vector<double> graded_outwards(double even, double h, double end, double ratio, int halvings)
{
  std::vector<double> points = equal_points(0, even, h);
  const auto outer = growing_points(even, end, h * ratio, ratio);
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
inline MeridianBlock spherical_cap(double sphere, const std::vector<double> &R,
                                   const std::vector<double> &height)
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
