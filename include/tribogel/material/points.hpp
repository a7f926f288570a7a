/// The bulk law at a row of points: one after the other, or as many at once as `Lanes` has lanes.
#pragma once

#include "tribogel/material/viscoelastic.hpp"
#include "tribogel/math/lanes.hpp"

#include <algorithm>
#include <vector>

namespace tribogel
{

/// At `count` points with these deformation gradients; the history is that of one point after the other. The
/// first failure ends it.
template <class T>
PointStatus evaluate_points(const Viscoelastic<T> &material, int count, const Matrix3<T> *F, const T *history,
                            StepWeights step, T *history_new, bool with_tangent, Response<T> *response)
{
  const int stride = material.history_size();
  for (int q = 0; q < count; ++q) {
    const HistoryLevels<T> levels{history ? history + q * stride : nullptr};
    response[q] =
        material.evaluate(F[q], levels, step, history_new ? history_new + q * stride : nullptr, with_tangent);
    if (response[q].status != PointStatus::ok) return response[q].status;
  }
  return PointStatus::ok;
}

/// The same by lanes; those that are left over at the end repeat the last point.
inline PointStatus evaluate_points(const Viscoelastic<Lanes> &material, int count, const Matrix3<double> *F,
                                   const double *history, StepWeights step, double *history_new,
                                   bool with_tangent, Response<double> *response)
{
  const int stride = material.history_size();
  static thread_local std::vector<Lanes> before, after; // not made anew for each cell
  before.resize(stride);
  after.resize(stride);
  for (int first = 0; first < count; first += Lanes::count) {
    const int width = std::min(Lanes::count, count - first);
    Matrix3<Lanes> gradient;
    for (int lane = 0; lane < Lanes::count; ++lane) {
      const int q = first + std::min(lane, width - 1);
      for (int k = 0; k < 9; ++k) gradient.data()[k].v[lane] = F[q].data()[k];
      for (int k = 0; k < stride; ++k) before[k].v[lane] = history[q * stride + k];
    }
    const Response<Lanes> all = material.evaluate(gradient, {before.data()}, step,
                                                  history_new ? after.data() : nullptr, with_tangent);
    for (int lane = 0; lane < width; ++lane) {
      Response<double> &one = response[first + lane];
      one.status = all.status;
      one.energy = all.energy.v[lane];
      one.dissipated = all.dissipated.v[lane];
      for (int k = 0; k < 6; ++k) one.tau[k] = all.tau[k].v[lane];
      for (int k = 0; with_tangent && k < 36; ++k) one.tangent.data()[k] = all.tangent.data()[k].v[lane];
      for (int k = 0; history_new && k < stride; ++k)
        history_new[(first + lane) * stride + k] = after[k].v[lane];
    }
    if (all.status != PointStatus::ok) return all.status;
  }
  return PointStatus::ok;
}

} // namespace tribogel
