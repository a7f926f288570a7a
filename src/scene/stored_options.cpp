#include "scene/stored_options.hpp"

#include "scene/option_table.hpp"
#include "scene/parse.hpp"
#include "scene/petsc_options.hpp"

#include <nlohmann/json.hpp>

namespace tribogel
{

namespace
{

using Json = nlohmann::json;

Json parsed(const std::string &stored)
{
  Json json = Json::parse(stored, nullptr, false);
  if (json.is_discarded() || !json.is_object())
    throw UserError{"-restart: the checkpoint's options are damaged; allowed: a checkpoint as it was written"};
  return json;
}

/// Text of the option `name` (with its dash) in a part of the stored options; null if it is not there.
const std::string *find(const Json &part, const std::string &name)
{
  const auto found = part.find(name);
  return found == part.end() ? nullptr : found->get_ptr<const std::string *>();
}

/// The same text or the same numbers.
bool same_value(const std::string &a, const std::string &b)
{
  const auto x = parse_reals(a), y = parse_reals(b);
  return a == b || (x.value && y.value && *x.value == *y.value);
}

/// May a run that is continued have another value of it? Branches beyond the first are in no table.
bool may_change(const std::string &name)
{
  const Option *option = find_option(name);
  return option && option->may_change;
}

PetscErrorCode AdoptPart(const Json &part)
{
  PetscBool given;
  PetscFunctionBeginUser;
  for (const auto &[name, text] : part.items()) {
    PetscCall(PetscOptionsHasName(nullptr, nullptr, name.c_str(), &given));
    const auto value = text.get<std::string>();
    if (!given) PetscCall(PetscOptionsSetValue(nullptr, name.c_str(), value.empty() ? nullptr : value.c_str()));
  }
  PetscFunctionReturn(0);
}

} // namespace

PetscErrorCode ReadRestart(std::string &directory)
{
  const char *text = nullptr;
  PetscBool given;
  PetscFunctionBeginUser;
  PetscCall(PetscOptionsFindPair(nullptr, nullptr, "-restart", &text, &given));
  directory = given && text ? text : "";
  PetscFunctionReturn(0);
}

std::string text_of_options(const SceneInput &input)
{
  Json given = Json::object(), resolved = Json::object(), solver = Json::object();
  for (const auto &[name, text] : input.given)
    if (name != "-output_directory" && name != "-overwrite" && name != "-restart") given[name] = text;
  for (const auto &[name, text] : input.options) resolved["-" + name] = text;
  const auto all = resolved_options(input);
  for (std::size_t k = input.options.size(); k < all.size(); ++k)
    if (all[k].first != "PETSC_OPTIONS" && !is_read_late(all[k].first)) solver["-" + all[k].first] = all[k].second;
  const Json all_of_them{{"given", given}, {"resolved", resolved}, {"solver", solver}};
  return all_of_them.dump(1, ' ', false, Json::error_handler_t::replace); // a path need not be UTF-8
}

PetscErrorCode AdoptOptions(const std::string &stored)
{
  const Json json = parsed(stored);
  PetscFunctionBeginUser;
  for (const char *part : {"given", "solver"}) PetscCall(AdoptPart(json.value(part, Json::object())));
  PetscFunctionReturn(0);
}

void expect_unchanged(const SceneInput &input, const std::string &stored)
{
  const Json json = parsed(stored), resolved = json.value("resolved", Json::object());
  for (const auto &[plain, text] : input.options) {
    const std::string name = "-" + plain, *before = find(resolved, name);
    if (may_change(name) || (before && same_value(text, *before))) continue;
    throw UserError{name + " = " + text + ": the run in " + input.scene.output.directory + " has " +
                    (before ? *before : "none") + "; allowed: to continue it, " +
                    (before ? "the same or nothing" : "nothing")};
  }
}

} // namespace tribogel
