/// Lagrange shape functions on [-1, 1]^dim, nodes in lexicographic order (the first coordinate runs fastest).
#pragma once

#include <array>

namespace tribogel
{

/// Values and derivatives of the 1-D basis with order + 1 equidistant nodes.
template <int order> struct LineShape {
  std::array<double, order + 1> value, slope;
};

template <int order> LineShape<order> line_shape(double xi)
{
  static_assert(order == 1 || order == 2);
  if constexpr (order == 1)
    return {{0.5 * (1 - xi), 0.5 * (1 + xi)}, {-0.5, 0.5}};
  else
    return {{0.5 * xi * (xi - 1), (1 - xi) * (1 + xi), 0.5 * xi * (xi + 1)}, {xi - 0.5, -2 * xi, xi + 0.5}};
}

constexpr int power(int base, int exponent)
{
  return exponent == 0 ? 1 : base * power(base, exponent - 1);
}

template <int dim, int order> inline constexpr int tensor_nodes = power(order + 1, dim);

/// Values N[a] and reference derivatives dN[a][j] of the tensor-product basis.
template <int dim, int order> struct TensorShape {
  std::array<double, tensor_nodes<dim, order>> N;
  std::array<std::array<double, dim>, tensor_nodes<dim, order>> dN;
};

template <int dim, int order> TensorShape<dim, order> tensor_shape(const std::array<double, dim> &xi)
{
  std::array<LineShape<order>, dim> line;
  for (int j = 0; j < dim; ++j) line[j] = line_shape<order>(xi[j]);
  TensorShape<dim, order> shape;
  for (int a = 0; a < tensor_nodes<dim, order>; ++a) {
    std::array<int, dim> index;
    for (int j = 0, rest = a; j < dim; ++j, rest /= order + 1) index[j] = rest % (order + 1);
    shape.N[a] = 1;
    for (int j = 0; j < dim; ++j) shape.N[a] *= line[j].value[index[j]];
    for (int j = 0; j < dim; ++j) {
      shape.dN[a][j] = 1;
      for (int k = 0; k < dim; ++k)
        shape.dN[a][j] *= k == j ? line[k].slope[index[k]] : line[k].value[index[k]];
    }
  }
  return shape;
}

} // namespace tribogel
