#include "options/stored_options.hpp"

#include "options/option_order.hpp"
#include "options/option_table.hpp"
#include "options/petsc_options.hpp"
#include "support/parse.hpp"

#include <nlohmann/json.hpp>

#include <filesystem>

namespace tribogel
{

namespace
{

using Json = nlohmann::json;

Json parsed(const std::string &stored)
{
  Json json = Json::parse(stored, nullptr, false);
  if (json.is_discarded() || !json.is_object())
    throw UserError{
        "-restart: the checkpoint's options are damaged; allowed: a checkpoint as it was written"};
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

/// Is it of one start only? Where a run shall stop is no part of what it is: it goes on without that limit.
bool is_of_one_start(const std::string &name)
{
  return name == "-output_directory" || name == "-overwrite" || name == "-restart" || name == "-ts_max_steps";
}

/// Unless it is given anew, in this or in another way.
PetscErrorCode AdoptPart(const Json &part)
{
  PetscFunctionBeginUser;
  for (const auto &[name, text] : part.items()) {
    PetscBool given, otherwise = PETSC_FALSE;
    PetscCall(PetscOptionsHasName(nullptr, nullptr, name.c_str(), &given));
    if (const char *other = other_way(name))
      PetscCall(PetscOptionsHasName(nullptr, nullptr, other, &otherwise));
    if (given || otherwise) continue;
    const auto value = text.get<std::string>();
    PetscCall(PetscOptionsSetValue(nullptr, name.c_str(), value.empty() ? nullptr : value.c_str()));
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
    if (!is_of_one_start(name)) given[name] = text;
  if (!input.mesh_file.empty()) given["-mesh_file"] = std::filesystem::absolute(input.mesh_file).string();
  for (const auto &[name, text] : input.options) resolved["-" + name] = text;
  const auto all = resolved_options(input);
  for (std::size_t k = input.options.size(); k < all.size(); ++k)
    if (const std::string name = "-" + all[k].first;
        all[k].first != "PETSC_OPTIONS" && !is_read_late(all[k].first) && !is_of_one_start(name))
      solver[name] = all[k].second;
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
  const Json json = parsed(stored), resolved = json.value("resolved", Json::object()),
             given = json.value("given", Json::object());
  for (const auto &[plain, text] : input.options) {
    const std::string name = "-" + plain, *before = find(resolved, name);
    if (may_change(name) || (before && same_value(text, *before))) continue;
    const auto now = input.given.find(name);
    const std::string *then = find(given, name);
    if (now == input.given.end() || (then && *then == now->second)) continue; // follows from what was given
    throw UserError{name + " = " + text + ": the run in " + input.output.directory + " has " +
                    (before ? *before : "none") + "; allowed: to continue it, " +
                    (before ? "the same or nothing" : "nothing")};
  }
}

} // namespace tribogel
