/// The contact operator of a slave surface of the top gel on the bottom gel's face, a curve's or a solid's,
/// behind one interface, for whoever knows unknowns and ranks. It also says which facets of a side wall may
/// touch, since that changes the operator.
#pragma once

#include "mesh/mesh.hpp"
#include "tribogel/contact/node/report.hpp"
#include "tribogel/contact/node/slave_node.hpp"
#include "tribogel/contact/node/state.hpp"

#include <functional>
#include <memory>
#include <utility>
#include <vector>

namespace tribogel
{

class ContactOperator
{
public:
  using Pairs = std::vector<std::pair<int, int>>; ///< of facets, slave and master, sorted
  using Emit = std::function<void(const ContactBlock &)>;

  /// Motions of the slave's plate.
  enum Motion { travel, turn };
  using AddSlope = std::function<void(Motion, const ContactUnknown &row, const Vector3<double> &)>;

  /// `on_crease` marks the nodes that a wall shares with the lower face; empty: the slave is that face.
  ContactOperator(const Mesh &mesh, const Scene &scene, const Surface &slave, std::vector<bool> on_crease);
  ContactOperator(ContactOperator &&) noexcept;
  ContactOperator &operator=(ContactOperator &&) noexcept;
  ~ContactOperator();

  /// Sufficient while the surfaces slide by less than margin [mm].
  Pairs candidate_pairs(const ContactState<double> &state, double margin) const;

  /// Mortar integrals that the slave nodes first <= a < last need; what follows is of the last update.
  MortarReport update(const ContactState<double> &state, const Pairs &pairs, bool derivatives, int first,
                      int last);

  void node(int a, NodeBlock &block) const;
  NodeResult result(int a) const;
  std::pair<double, double> resultant(int a) const; ///< force along z, torque about it on the slave [N, N mm]
  SurfacePlace slave_place(int a) const;
  SurfacePlace master_place(int b) const;

  /// The Jacobian's blocks of these nodes, and the rows and columns that they can have with these pairs.
  void jacobian(int first, int last, const Emit &emit) const;
  void pattern(const Pairs &pairs, int first, int last, const Emit &emit) const;

  /// d residual / d travel [N/mm] and / d angle [N/rad] of the slave's plate, whose rates change by shift
  /// times as much, of these nodes' rows in parts that add up.
  void motion_slopes(int first, int last, const AddSlope &add) const;

  const Friction &friction() const;
  const SlaveNode &constants(int a) const;
  double slave_size() const; ///< undeformed [mm or mm^2]
  double facet_size() const; ///< mean [mm]

  bool is_wall() const;
  const std::vector<bool> &on_crease() const;
  const std::vector<bool> &touching() const; ///< facets of a wall that may touch

  /// Those of the facets that touch now without the ones that failed, and what is cut off from the crease by
  /// that.
  std::vector<bool> touching_without(const std::vector<int> &failed) const;

  /// Rebuilds the operator for contact of these facets.
  void touch(std::vector<bool> facets);

  /// For contact of the facets of a wall that lean over the master at this state and are near it.
  void roll(const ContactState<double> &state);

private:
  struct Operators;
  std::unique_ptr<Operators> is;
};

} // namespace tribogel
