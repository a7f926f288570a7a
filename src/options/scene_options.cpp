/// What is simulated: the model and what stands between the plates.
#include "options/option_groups.hpp"
#include "options/option_reader.hpp"

namespace tribogel
{

namespace
{

std::vector<OptionGroup> declare_scene()
{
  return {{"Scene",
           {{.name = "-model",
             .kind = OptionKind::choice,
             .fallback = "axisymmetric",
             .meaning = "axisymmetric: coaxial specimens of revolution with any rotation, in the (R, Z) half "
                        "plane; solid: "
                        "in space",
             .source = "own",
             .choices = {"axisymmetric", "solid"}},
            {.name = "-task",
             .kind = OptionKind::choice,
             .fallback = "simulate",
             .meaning = "simulate: from the scene to force, torque and profiles",
             .source = "own",
             .choices = {"simulate"}},
            {.name = "-specimens",
             .kind = OptionKind::choice,
             .fallback = "both",
             .meaning = "both: two gels in contact; bottom: one gel bonded to both plates, no contact",
             .source = "paper",
             .choices = {"both", "bottom"}},
            {.name = "-counterface",
             .kind = OptionKind::choice,
             .fallback = "gel",
             .meaning = "what the top gel is pressed on: gel: the bottom gel; rigid: a plane at z = 0 in its "
                        "place, which does not yield, as glass or metal",
             .source = "paper",
             .choices = {"gel", "rigid"}}}}};
}

void read_arrangement(const OptionReader &reader, Scene &scene)
{
  const Option &counterface = OptionReader::declared("-counterface");
  const bool rigid = reader.choice(counterface.name) == "rigid";
  if (reader.choice("-specimens") == "bottom") {
    scene.arrangement = Arrangement::single_gel;
    if (rigid)
      refuse(counterface.name, "rigid",
             "allowed: gel with -specimens bottom, one gel that is bonded to both plates");
  } else
    scene.arrangement = rigid ? Arrangement::gel_on_rigid : Arrangement::gel_on_gel;
}

void read_scene(const OptionReader &reader, SceneInput &input)
{
  reader.choice("-task");
  read_arrangement(reader, input.scene);
  if (reader.choice("-model") == "solid") input.scene.model = Model::solid;
}

} // namespace

OptionSubject scene_options()
{
  return {declare_scene, read_scene};
}

} // namespace tribogel
