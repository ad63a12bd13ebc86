#include "input/catalogue_table.hpp"

#include <string>
#include <utility>
#include <vector>

namespace epicyclic::input {

namespace {

using gear::Catalogue;
using gear::ComplianceOptions;
using gear::ExternalGear;
using gear::RingGear;

const Bounds length_bounds = between(length_min_mm, length_max_mm);
const Bounds factor = between(1e-6, 100);
const Bounds coefficient = between(0, 5);

const Table<gear::Relief>& relief_table(const std::string& name) {
  static const auto make = [](const std::string& key, const std::string& end) {
    using gear::Relief;
    using gear::ReliefShape;
    Table<Relief> t(key, "Relief of the flanks towards the " + end + ".");
    t.number("amount_um", &Relief::amount_um, between(0, 1e4),
             "Material that is taken off, along the line of action, at the " +
                 std::string(end == "tip" ? "tip circle" : "lowest point of contact") + " [um].")
        .required();
    t.number("start_diameter_mm", &Relief::start_diameter_mm, length_bounds, "Diameter where the relief starts [mm].");
    t.number("start_roll_mm", &Relief::start_roll_mm, length_bounds,
             "Length of roll where the relief starts, sqrt(r^2 - r_b^2), in place of the diameter [mm].");
    t.choice("shape", &Relief::shape,
             std::vector<std::pair<std::string, ReliefShape>>{{"linear", ReliefShape::linear},
                                                              {"parabolic", ReliefShape::parabolic},
                                                              {"circular", ReliefShape::circular}},
             "Shape over the length of roll.");
    t.rule(KeyRule::Kind::exactly_one, {"start_diameter_mm", "start_roll_mm"});
    return t;
  };
  static const auto tip = make("tip_relief", "tip");
  static const auto root = make("root_relief", "root");
  return name == "tip" ? tip : root;
}

template <class T>
void add_gear_data(Table<T>& t) {
  const auto data = [](auto member) {
    return [member](auto& gear) -> auto& { return gear.data.*member; };
  };
  using gear::GearData;
  t.integer("teeth", data(&GearData::teeth), between(3, 10000), "Number of teeth [-].").required();
  t.number("module_mm", data(&GearData::module_mm), length_bounds, "Module of the reference profile [mm].").required();
  t.number("pressure_angle_deg", data(&GearData::pressure_angle_deg), between(5, 45),
           "Pressure angle of the reference profile [deg].");
  t.number("profile_shift", data(&GearData::profile_shift), between(-5, 5),
           "Profile shift coefficient x [-]; positive makes external teeth, and the spaces of a ring, thicker.");
  t.number("addendum_coefficient", data(&GearData::addendum_coefficient), coefficient, "Addendum coefficient [-].");
  t.number("clearance_coefficient", data(&GearData::clearance_coefficient), coefficient,
           "Tip clearance coefficient of the reference profile [-].");
  t.number("width_mm", data(&GearData::width_mm), length_bounds,
           "Face width [mm]; of two gears in mesh the smaller one bears and yields.")
      .required();
  t.number("tip_diameter_mm", data(&GearData::tip_diameter_mm), length_bounds,
           "Diameter of the tip circle [mm]; decides over addendum coefficient and tip shortening.");
  t.number("root_diameter_mm", data(&GearData::root_diameter_mm), length_bounds,
           "Diameter of the root circle [mm]; decides over the coefficients.");
  const auto relief = [](std::optional<gear::Relief> GearData::*member) {
    return table_detail::Access<T, gear::Relief>{[=](T& gear) -> gear::Relief& {
                                                   auto& held = gear.data.*member;
                                                   if (!held) held.emplace();
                                                   return *held;
                                                 },
                                                 [=](const T& gear) -> const gear::Relief* {
                                                   const auto& held = gear.data.*member;
                                                   return held ? &*held : nullptr;
                                                 }};
  };
  t.object("tip_relief", relief(&GearData::tip_relief), relief_table("tip"));
  t.object("root_relief", relief(&GearData::root_relief), relief_table("root"));
  t.number("crowning_um", data(&GearData::crowning_um), between(0, 1e4),
           "Crowning over the whole face width, parabolic, at the ends of the face [um].");
  t.integer(
      "accuracy_grade", [](auto& gear) -> auto& { return gear.accuracy_grade; }, between(0, 12),
      "Accuracy grade of ISO 1328-1:1995 [-]; gives the amplitude of the transmission error.");
  t.number(
      "root_half_angle_deg", [](auto& gear) -> auto& { return gear.root_half_angle_deg; }, between(0.1, 45),
      "Half of the angle that a tooth takes at its root circle, for the compliance of the body [deg]; that of the "
      "profile if not given.");
}

const Table<ExternalGear>& external_table(const std::string& name) {
  static const auto make = [](const std::string& member) {
    Table<ExternalGear> t(member, "Drawing of the " + member +
                                      (member == "sun" ? ", or of gear 1 of a pair." : ", or of gear 2 of a pair."));
    add_gear_data(t);
    t.number("bore_mm", &ExternalGear::bore_mm, between(0, length_max_mm), "Diameter of the bore [mm].");
    t.number("body_radius_ratio", &ExternalGear::body_radius_ratio, between(1.01, 100),
             "Root radius over inner radius of the elastic body under the teeth, an annulus held fast along its inner "
             "circle [-]. The default is for gears that do not wind up about their bore: solid, on a shaft of their "
             "own, idling on a bearing.");
    return t;
  };
  static const auto sun = make("sun");
  static const auto planet = make("planet");
  return name == "sun" ? sun : planet;
}

const Table<RingGear>& ring_table() {
  static const auto table = [] {
    Table<RingGear> t("ring", "Drawing of the ring; a pair has none.");
    add_gear_data(t);
    t.number("outer_diameter_mm", &RingGear::outer_diameter_mm, length_bounds,
             "Outer diameter of the rim [mm]; gives mass and inertia.");
    t.choice("base_pitch", &RingGear::base_pitch,
             std::vector<std::pair<std::string, gear::BasePitch>>{{"as_given", gear::BasePitch::as_given},
                                                                  {"of_planet", gear::BasePitch::of_planet}},
             "Whether the ring's module stands as it is, or is replaced so that its base pitch is the planet's.");
    return t;
  }();
  return table;
}

const Table<gear::Material>& material_table() {
  static const auto table = [] {
    using gear::Material;
    Table<Material> t("material", "Material of all gears.");
    t.number("youngs_modulus_GPa", &Material::youngs_modulus_GPa, between(1e-6, 2000), "Young's modulus [GPa].");
    t.number("poisson_ratio", &Material::poisson_ratio, between(0, 0.49), "Poisson's ratio [-].");
    t.number("density_kg_per_m3", &Material::density_kg_per_m3, between(1e-3, 50000), "Density [kg/m3].");
    return t;
  }();
  return table;
}

const Table<gear::SupportBearing>& bearing_table() {
  static const auto table = [] {
    using gear::SupportBearing;
    Table<SupportBearing> t("bearing", "Bearing of a support.");
    t.text("type", &SupportBearing::type,
           "Designation of a rolling bearing, such as 6213, NU213, NA4913 or NCF3013V; gives the support's stiffness.");
    t.integer("balls", &SupportBearing::balls, between(3, 1000), "Number of balls, in place of a type [-].");
    t.number("ball_diameter_mm", &SupportBearing::ball_diameter_mm, length_bounds, "Diameter of a ball [mm].");
    t.number("contact_angle_deg", &SupportBearing::contact_angle_deg, from_below(0, 90), "Contact angle [deg].");
    t.integer("rollers", &SupportBearing::rollers, between(3, 1000),
              "Number of cylindrical rollers or needles, in place of a type [-].");
    t.number("roller_length_mm", &SupportBearing::roller_length_mm, length_bounds,
             "Effective length of a roller [mm].");
    t.rule(KeyRule::Kind::exactly_one, {"type", "balls", "rollers"});
    t.rule(KeyRule::Kind::together, {"balls", "ball_diameter_mm"});
    t.rule(KeyRule::Kind::together, {"rollers", "roller_length_mm"});
    t.number("approach_um", &SupportBearing::approach_um, between(1e-6, 1e4),
             "Elastic approach at which the tangent stiffness is taken [um].");
    return t;
  }();
  return table;
}

const Table<gear::CarrierBody>& body_table() {
  static const auto table = [] {
    using gear::CarrierBody;
    Table<CarrierBody> t("body", "Carrier of round plates and one pin per planet.");
    t.integer("plates", &CarrierBody::plates, between(1, 10), "Number of plates [-].");
    t.number("plate_thickness_mm", &CarrierBody::plate_thickness_mm, length_bounds, "Thickness of a plate [mm].")
        .required();
    t.number("outer_diameter_mm", &CarrierBody::outer_diameter_mm, length_bounds, "Outer diameter of a plate [mm].")
        .required();
    t.number("inner_diameter_mm", &CarrierBody::inner_diameter_mm, between(0, length_max_mm),
             "Inner diameter of a plate [mm].");
    t.number("pin_diameter_mm", &CarrierBody::pin_diameter_mm, length_bounds, "Diameter of a pin [mm].").required();
    t.number("pin_length_mm", &CarrierBody::pin_length_mm, length_bounds,
             "Length of a pin between the plates, which count as solid discs [mm].")
        .required();
    return t;
  }();
  return table;
}

const Table<gear::OutputShaft>& shaft_table() {
  static const auto table = [] {
    using gear::OutputShaft;
    Table<OutputShaft> t("shaft", "Shaft that holds a grounded carrier by its torsional stiffness.");
    t.number("diameter_mm", &OutputShaft::diameter_mm, length_bounds, "Outer diameter [mm].").required();
    t.number("inner_diameter_mm", &OutputShaft::inner_diameter_mm, between(0, length_max_mm), "Inner diameter [mm].");
    t.number("length_mm", &OutputShaft::length_mm, length_bounds, "Length [mm].").required();
    return t;
  }();
  return table;
}

const Table<gear::CarrierData>& carrier_table() {
  static const auto table = [] {
    using gear::CarrierData;
    Table<CarrierData> t("carrier", "Drawing of the carrier.");
    t.object("body", present(&CarrierData::body), body_table());
    t.object("bearing", present(&CarrierData::bearing), bearing_table());
    t.object("shaft", present(&CarrierData::shaft), shaft_table());
    return t;
  }();
  return table;
}

const Table<gear::StiffnessOptions>& stiffness_table() {
  static const auto table = [] {
    using gear::Fillet;
    using gear::FoundationLever;
    using gear::RingFoundation;
    using gear::StiffnessForm;
    using gear::StiffnessOptions;
    Table<StiffnessOptions> t("mesh_stiffness", "How the mesh stiffness is computed and enters the model.");
    const auto of = [](auto member) {
      return [member](auto& s) -> auto& { return s.compliance.*member; };
    };
    t.boolean("bending", of(&ComplianceOptions::bending), "Whether bending of the teeth counts.");
    t.boolean("shear", of(&ComplianceOptions::shear), "Whether shear of the teeth counts.");
    t.boolean("axial", of(&ComplianceOptions::axial), "Whether axial compression of the teeth counts.");
    t.boolean("hertz", of(&ComplianceOptions::hertz), "Whether Hertz's contact flattening counts.");
    t.boolean("foundation", of(&ComplianceOptions::foundation), "Whether the elastic body under the teeth counts.");
    t.choice("fillet", of(&ComplianceOptions::fillet),
             std::vector<std::pair<std::string, Fillet>>{{"none", Fillet::none}, {"trochoid", Fillet::trochoid}},
             "What lies between involute and root circle of sun and planet: nothing, or the fillet that a rack cuts.");
    t.choice("ring_foundation", of(&ComplianceOptions::ring_foundation),
             std::vector<std::pair<std::string, RingFoundation>>{{"half_plane", RingFoundation::half_plane},
                                                                 {"rigid", RingFoundation::rigid}},
             "Elastic body under the ring's teeth.");
    t.choice("foundation_lever", of(&ComplianceOptions::lever),
             std::vector<std::pair<std::string, FoundationLever>>{{"centreline", FoundationLever::centreline},
                                                                  {"contact_height", FoundationLever::contact_height}},
             "Where the lever of the force on the body of sun and planet ends.");
    t.choice("form", &StiffnessOptions::form,
             std::vector<std::pair<std::string, StiffnessForm>>{{"harmonics", StiffnessForm::harmonics},
                                                                {"curve", StiffnessForm::curve}},
             "Fourier series, or the whole curve with its jumps.");
    t.integer("harmonics", &StiffnessOptions::harmonics, between(1, 64), "Harmonics of the Fourier series [-].");
    t.number("sun_planet_factor", &StiffnessOptions::sun_planet_factor, factor,
             "Factor on the computed stiffness of the sun-planet mesh [-].");
    t.number("ring_planet_factor", &StiffnessOptions::ring_planet_factor, factor,
             "Factor on the computed stiffness of the ring-planet mesh [-].");
    t.number(
        "design_torque_Nm", &StiffnessOptions::design_torque_Nm, between(1e-9, 1e9),
        "Torque on the sun or on gear 1, at which the contact of modified flanks is computed; by default that of the "
        "load [N m].");
    t.number("table_tolerance", &StiffnessOptions::table_tolerance, table_tolerance,
             "Error that the rows of the whole curve are made fine enough for, relative to the mean [-].");
    return t;
  }();
  return table;
}

const Table<gear::Lubrication>& lubrication_table() {
  static const auto table = [] {
    using gear::Lubrication;
    Table<Lubrication> t("lubrication", "Lubricant and roughness for the friction of the teeth; none without it.");
    t.number("viscosity_mPas", &Lubrication::viscosity_mPas, between(1, 2000),
             "Dynamic viscosity of the oil at its inlet [mPa s].");
    t.number("roughness_um", &Lubrication::roughness_um, between(0, 1.5), "RMS roughness of the flanks [um].");
    t.number("table_tolerance", &Lubrication::table_tolerance, table_tolerance,
             "Error that the rows of load shares and of friction over normal force are made fine enough for [-].");
    t.rule(KeyRule::Kind::not_empty, {"viscosity_mPas", "roughness_um"});
    return t;
  }();
  return table;
}

}  // namespace

const Table<Catalogue>& catalogue_table() {
  static const auto table = [] {
    Table<Catalogue> t("catalogue", "Drawings and catalogue data, from which the lumped values are computed.");
    t.object("material", &Catalogue::material, material_table());
    t.choice(
        "tips", &Catalogue::tips,
        std::vector<std::pair<std::string, gear::Tips>>{{"shortened", gear::Tips::shortened},
                                                        {"full", gear::Tips::full}},
        "Whether the tips of sun and planet are shortened to keep their clearance at the working centre distance.");
    t.choice(
        "error_amplitude", &Catalogue::error_amplitude,
        std::vector<std::pair<std::string, gear::ErrorAmplitude>>{{"profile_form", gear::ErrorAmplitude::profile_form},
                                                                  {"single_pitch", gear::ErrorAmplitude::single_pitch}},
        "Tolerance of ISO 1328-1 that gives the amplitude of the transmission error at mesh frequency: half of "
        "the profile form deviation, or the single pitch deviation.");
    t.object("sun", &Catalogue::sun, external_table("sun")).required();
    t.object("sun_bearing", present(&Catalogue::sun_bearing), bearing_table());
    t.object("planet", &Catalogue::planet, external_table("planet")).required();
    t.object("planet_bearing", present(&Catalogue::planet_bearing), bearing_table());
    t.object("ring",
             table_detail::Access<Catalogue, RingGear>{
                 [](Catalogue& c) -> RingGear& { return c.ring; },
                 [](const Catalogue& c) -> const RingGear* { return c.has_ring() ? &c.ring : nullptr; }},
             ring_table());
    t.object("carrier", &Catalogue::carrier, carrier_table());
    t.object("mesh_stiffness", &Catalogue::stiffness, stiffness_table());
    t.object("lubrication", present(&Catalogue::lubrication), lubrication_table());
    return t;
  }();
  return table;
}

}  // namespace epicyclic::input
