/// What GelContact keeps out of its header: the operators' templates are most of what it takes to compile.
#pragma once

#include "tribogel/contact/axisymmetric_contact.hpp"
#include "tribogel/contact/solid_contact.hpp"

#include <variant>

namespace tribogel
{

struct ContactModel {
  std::variant<AxisymmetricContact, SolidContact> contact;
  ContactParameters parameters; ///< of a curve

  AxisymmetricContact &curve() { return std::get<AxisymmetricContact>(contact); }
  const AxisymmetricContact &curve() const { return std::get<AxisymmetricContact>(contact); }
};

} // namespace tribogel
