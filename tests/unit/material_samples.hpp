/// Materials and deformations for the tests of the bulk law. No parameter is 0, 1 or equal to another by
/// accident.
#pragma once

#include "tribogel/material/viscoelastic.hpp"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

namespace samples
{

using tribogel::Matrix3;
using tribogel::Ogden;
using tribogel::Vector3;
using tribogel::Viscoelastic;

/// The paper's gel, as its scene reads Table 1.
inline Viscoelastic<double> paper()
{
  return {{{0.75, 0.45, 0.18}, {1.3, 2, 5}, 200}, {{{{0.25, 0.45, 0.18}, {1.3, 2, 5}, 200}, 4.5, 200}}};
}

/// Two different branches, a negative exponent with its negative modulus, moderate bulk moduli.
inline Viscoelastic<double> odd()
{
  return {{{0.61, -0.23}, {2.7, -1.9}, 3.7},
          {{{{0.37, -0.11, 0.05}, {1.6, -2.2, 4.1}, 2.9}, 0.83, 5.3}, {{{-0.47}, {-3.1}, 7.7}, 13.0, 2.1}}};
}

/// No branches at all.
inline Viscoelastic<double> hyperelastic()
{
  return {{{0.52, 0.19, -0.07}, {1.4, 3.3, -2.6}, 11.0}, {}};
}

/// Two branches and the other volumetric law in all springs.
inline Viscoelastic<double> quadratic()
{
  Viscoelastic<double> material = odd();
  material.equilibrium.volumetric_law = tribogel::VolumetricLaw::quadratic;
  for (auto &branch : material.branches) branch.spring.volumetric_law = tribogel::VolumetricLaw::quadratic;
  return material;
}

/// Proper rotation number `seed`.
inline Matrix3<double> rotation(int seed)
{
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  const auto next = [&] { return normal(random); };
  const double w = next(), x = next(), y = next(), z = next();
  return Eigen::Quaterniond(w, x, y, z).normalized().toRotationMatrix();
}

/// A matrix with entries between -1 and 1, number `seed`.
inline Matrix3<double> noise(int seed)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  return Matrix3<double>::NullaryExpr([&] { return uniform(random); });
}

inline Matrix3<double> symmetric_noise(int seed)
{
  const Matrix3<double> A = noise(seed);
  return 0.5 * (A + A.transpose());
}

/// Stretches along the axes of one rotation, followed by another.
inline Matrix3<double> stretched(double a, double b, double c, int seed)
{
  const Matrix3<double> Q = rotation(seed), R = rotation(seed + 1000);
  return R * Q * Vector3<double>(a, b, c).asDiagonal() * Q.transpose();
}

/// History of every branch after some other deformation: symmetric, positive definite, not isochoric, not the
/// identity.
inline std::vector<double> history(const Viscoelastic<double> &material, int seed)
{
  std::vector<double> h;
  for (std::size_t m = 0; m < material.branches.size(); ++m) {
    const Matrix3<double> A = Matrix3<double>::Identity() + 0.2 * noise(seed + 17 * static_cast<int>(m));
    const Matrix3<double> X = A * A.transpose();
    const tribogel::Mandel<double> v = tribogel::to_mandel(X);
    h.insert(h.end(), v.data(), v.data() + 6);
  }
  return h;
}

inline std::vector<double> initial(const Viscoelastic<double> &material)
{
  std::vector<double> h(material.history_size());
  material.initial_history(h.data());
  return h;
}

/// The virgin state and one left by another deformation.
inline std::vector<std::vector<double>> histories(const Viscoelastic<double> &material)
{
  return {initial(material), history(material, 41)};
}

/// One step that must succeed.
struct Step {
  tribogel::Response<double> response;
  std::vector<double> history;
};

inline Step take(const Viscoelastic<double> &material, const Matrix3<double> &F,
                 const std::vector<double> &history, double step, bool with_tangent = true)
{
  Step out;
  out.history.assign(history.size(), 0);
  out.response = material.evaluate(F, {history.data()}, {step}, out.history.data(), with_tangent);
  EXPECT_EQ(out.response.status, tribogel::PointStatus::ok);
  return out;
}

struct NamedDeformation {
  std::string name;
  Matrix3<double> F;
};

/// Deformations with all, two or no principal stretches equal, and close to that.
inline std::vector<NamedDeformation> deformations()
{
  const Matrix3<double> one = Matrix3<double>::Identity();
  std::vector<NamedDeformation> list{{"identity", one},
                                     {"rotation", rotation(3)},
                                     {"dilatation", 1.07 * rotation(4)},
                                     {"uniaxial", Vector3<double>(0.8, 0.8, 1.45).asDiagonal()},
                                     {"turned uniaxial", stretched(1.3, 1.3, 0.7, 5)},
                                     {"general", stretched(1.6, 0.9, 0.65, 6)},
                                     {"large", stretched(2.9, 0.7, 0.4, 7)}};
  for (double perturbation : {1e-16, 1e-12, 1e-9, 1e-8, 1e-6, 1e-4}) {
    const std::string tag = " + " + std::to_string(std::log10(perturbation));
    list.push_back({"identity" + tag, one + perturbation * noise(8)});
    list.push_back({"uniaxial" + tag, stretched(1.3, 1.3, 0.7, 5) + perturbation * noise(9)});
  }
  return list;
}

} // namespace samples
