/// What the contact operators of both models answer.
#pragma once

#include "tribogel/contact/node/condition.hpp"

#include <vector>

namespace tribogel
{

enum class MortarStatus {
  ok,
  folded,        ///< a facet is inside out, or seen from behind
  no_projection, ///< a projection did not converge, or data are not finite
  uncovered      ///< the candidate pairs do not cover a slave facet: search again
};

struct MortarReport {
  MortarStatus status = MortarStatus::ok; ///< of the first slave facet that failed
  std::vector<int> failed;                ///< slave facets, ascending
  /// Reference length or area of slave beyond the master's edge [mm or mm^2], each facet counted once over
  /// all ranges of nodes.
  double overhang = 0;

  void add_failure(MortarStatus why, int facet)
  {
    if (failed.empty()) status = why;
    failed.push_back(facet);
  }
};

/// Where a node of a surface is, about the axis of its body's plate and in the frame that turns with it: (r
/// [mm], theta [rad], z [mm]).
struct SurfacePlace {
  Vector3<double> reference, current;
};

/// What observers want to know of a slave node. Vectors are in the node's own frame (r, theta, z). NaN where
/// no multiplier is carried.
struct NodeResult {
  bool carries;
  ContactStatus status;
  double weight;                   ///< nominal traction times weight is a force [mm^2]
  double area;                     ///< current: Cauchy traction times area is the same force [mm^2]
  double gap;                      ///< [mm]
  double pressure;                 ///< Cauchy [MPa]
  Vector3<double> nominal, cauchy; ///< traction on the slave [MPa]
  Vector3<double> velocity;        ///< sliding velocity, slave minus master, tangential part [mm/s]
  Vector3<double> normal;          ///< unit, out of the slave
};

/// One slave node's contribution. Columns: the unknowns of each slave node, of each master node, then the
/// multiplier of node a; rows: the unknowns of the first `slave_rows` slave nodes (a itself, and the crease
/// node tied to it), of each master node, then the conditions.
struct NodeBlock {
  std::vector<int> slave_nodes, master_nodes;
  int slave_rows = 1;       ///< 2 where the multiplier is extended to a crease
  Eigen::VectorXd residual; ///< [N]
  Eigen::MatrixXd
      jacobian; ///< with d rate / d u = shift; axisymmetric only, after update(derivatives = true)
  ContactStatus status;
};

/// Three unknowns of a node, or the three rows that go with them.
struct ContactUnknown {
  enum Kind { slave, master, multiplier } kind;
  int node;
  bool operator==(const ContactUnknown &) const = default;
};

/// A dense part of the Jacobian, three rows and columns for each entry of the lists.
struct ContactBlock {
  std::vector<ContactUnknown> rows, columns;
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> values;
};

} // namespace tribogel
