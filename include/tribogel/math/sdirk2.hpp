/// Coefficients of SDIRK2, the L-stable singly diagonally implicit Runge-Kutta rule with two stages and order
/// 2 (Alexander 1977). Both stages are backward Euler solves of the length gamma h; the second ends with the
/// step.
#pragma once

#include <numbers>

namespace tribogel::sdirk2
{

/// The root of 1 - 4 gamma + 2 gamma^2 between 0 and 1, 1 - 1/sqrt(2): length of a stage over that of the
/// step.
inline constexpr double gamma = 1 - 0.5 * std::numbers::sqrt2;

/// The second stage starts where the first, from its start to its end, arrives when carried on so far, THEORY
/// (4.4).
inline constexpr double reach = (1 - gamma) / gamma;

/// Of h^3 y''' in the local error of y' = lambda y: 3 gamma^2 - 2 gamma^3 - 1/6, THEORY (4.7).
inline constexpr double error_constant = gamma * gamma * (3 - 2 * gamma) - 1.0 / 6;

/// Where U follows something prescribed, the second stage's rate is U' + rate_lag h U'' at the step's end,
/// THEORY (4.6).
inline constexpr double rate_lag = 0.5 * (1 / gamma - 1 + gamma) - 1;

} // namespace tribogel::sdirk2
