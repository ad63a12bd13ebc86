#include "store/stage_columns.hpp"

#include <array>
#include <functional>
#include <numbers>
#include <string>

#include "gear/kinematics.hpp"

namespace epicyclic::store {

namespace {

using studies::Course;
using studies::MeshHarmonics;
using studies::MeshRecord;
using studies::StageRecord;

using Number = StageColumn::Getter<double>;
using Words = StageColumn::Getter<std::string>;

/// One kind of mesh.
struct Kind {
  const char* suffix;
  const char* name;
  std::vector<MeshRecord> StageRecord::*meshes;
  MeshHarmonics StageRecord::*harmonics;
};
constexpr std::array<Kind, 2> kinds = {
    {{"sp", "sun-planet", &StageRecord::sun_planet, &StageRecord::sun_planet_harmonics},
     {"rp", "ring-planet", &StageRecord::ring_planet, &StageRecord::ring_planet_harmonics}}};

using CourseOf = std::function<const Course&(const StageRecord&)>;

CourseOf course_of(const Kind& kind, std::size_t planet, Course MeshRecord::*what) {
  return
      [meshes = kind.meshes, planet, what](const StageRecord& r) -> const Course& { return (r.*meshes)[planet].*what; };
}

void add(std::vector<StageColumn>& all, std::string name, const char* unit, std::string meaning, Number value) {
  all.push_back({std::move(name), unit, std::move(meaning), std::move(value)});
}

void add(std::vector<StageColumn>& all, std::string name, const char* unit, std::string meaning, const CourseOf& of,
         double Course::*member) {
  add(all, std::move(name), unit, std::move(meaning),
      Number([of, member](const StageRecord& r) { return of(r).*member; }));
}

void add_range(std::vector<StageColumn>& all, const std::string& what, const std::string& meaning, const CourseOf& of) {
  add(all, what + "_range", "b_c", "peak to peak of " + meaning,
      Number([of](const StageRecord& r) { return of(r).range(); }));
}

/// The mean, and the signal without it.
void add_mean_and_rms(std::vector<StageColumn>& all, const std::string& what, const char* unit,
                      const std::string& meaning, const CourseOf& of) {
  add(all, what + "_mean", unit, "time mean of " + meaning, of, &Course::mean);
  add(all, what + "_rms", unit, "root mean square of " + meaning + " about its mean", of, &Course::rms);
}

void add_harmonics(std::vector<StageColumn>& all, const std::string& what, const std::string& meaning,
                   MeshHarmonics StageRecord::*harmonics) {
  constexpr std::size_t count = std::tuple_size_v<MeshHarmonics>;
  for (std::size_t h = 0; h < count; ++h)
    add(all, what + "_h" + std::to_string(h + 1), "b_c",
        "amplitude of " + meaning + " at " + (h == 0 ? "" : std::to_string(h + 1) + " times ") + "the mesh frequency",
        Number([harmonics, h](const StageRecord& r) { return (r.*harmonics)[h]; }));
}

void add_force(std::vector<StageColumn>& all, const std::string& what, const std::string& meaning, const CourseOf& of) {
  add_mean_and_rms(all, what, "N", meaning, of);
  add(all, what + "_max", "N", "largest of " + meaning, of, &Course::largest);
}

void add_extrema(std::vector<StageColumn>& all, const std::string& what, const std::string& mesh, const CourseOf& of) {
  add(all, what + "_min", "b_c", "least deflection of " + mesh + " in the record", of, &Course::least);
  add(all, what + "_max", "b_c", "largest deflection of " + mesh, of, &Course::largest);
}

StageColumn contact_of(const Kind& kind, const std::string& suffix, std::size_t planet, const std::string& mesh) {
  return {"contact_" + suffix, "", "contact of " + mesh + " seen in the record: drive, loss, back",
          Words([meshes = kind.meshes, planet](const StageRecord& r) { return (r.*meshes)[planet].contact(); })};
}

std::string mesh_words(const Kind& kind, std::size_t planet) {
  return std::string(kind.name) + " mesh " + std::to_string(planet + 1);
}

}  // namespace

bool is_of_pair(std::string_view column) {
  const auto has = [column](std::string_view part) { return column.find(part) != std::string_view::npos; };
  return !has("_rp") && !has("load_sharing") && !has("k_gamma") && column != "planet_spread" &&
         column != "carrier_speed_rpm";
}

std::vector<StageColumn> contact_columns() {
  std::vector<StageColumn> all;
  for (const Kind& kind : kinds)
    add_extrema(all, std::string("delta_") + kind.suffix, mesh_words(kind, 0), course_of(kind, 0, &MeshRecord::delta));
  for (const Kind& kind : kinds) all.push_back(contact_of(kind, kind.suffix, 0, mesh_words(kind, 0)));
  return all;
}

std::vector<StageColumn> stage_columns() {
  std::vector<StageColumn> all;
  add(all, "planet_spread", "b_c", "largest difference between planets' deflections",
      Number([](const StageRecord& r) { return r.planet_spread; }));
  add(all, "tensile_force_sp", "static mesh force", "largest tensile force of a sun mesh, from its damping",
      Number([](const StageRecord& r) { return StageRecord::tension(r.sun_planet); }));
  add(all, "tensile_force_rp", "static mesh force", "largest tensile force of a ring mesh, from its damping",
      Number([](const StageRecord& r) { return StageRecord::tension(r.ring_planet); }));
  add(all, "tensile_time_sp", "part of the time", "longest time with tensile force in a sun mesh",
      Number([](const StageRecord& r) { return StageRecord::tension_time(r.sun_planet); }));
  add(all, "tensile_time_rp", "part of the time", "longest time with tensile force in a ring mesh",
      Number([](const StageRecord& r) { return StageRecord::tension_time(r.ring_planet); }));
  for (const Kind& kind : kinds)
    add(all, std::string("loss_time_") + kind.suffix, "part of the time",
        std::string("longest time out of contact of any ") + kind.name + " mesh",
        Number([meshes = kind.meshes](const StageRecord& r) { return StageRecord::loss_time(r.*meshes); }));
  for (const Kind& kind : kinds) {
    const std::string what = std::string("delta_") + kind.suffix;
    const std::string meaning = "the deflection of " + mesh_words(kind, 0);
    add_mean_and_rms(all, what, "b_c", meaning, course_of(kind, 0, &MeshRecord::delta));
    add_range(all, what, meaning, course_of(kind, 0, &MeshRecord::delta));
    add_harmonics(all, what, meaning, kind.harmonics);
  }
  const CourseOf error = [](const StageRecord& r) -> const Course& { return r.transmission_error; };
  const std::string te = "transmission_error";
  add_mean_and_rms(all, te, "b_c", "the stage's transmission error", error);
  add_range(all, te, "the stage's transmission error", error);
  add_harmonics(all, te, "the stage's transmission error", &StageRecord::transmission_error_harmonics);
  for (const Kind& kind : kinds)
    add_force(all, std::string("force_") + kind.suffix, "the force of " + mesh_words(kind, 0),
              course_of(kind, 0, &MeshRecord::force));
  for (const Kind& kind : kinds)
    add(all, std::string("dynamic_factor_") + kind.suffix, "1",
        std::string("largest force of any ") + kind.name +
            " mesh over the static force F_0 of a sun-planet mesh: dynamics and load sharing",
        Number([meshes = kind.meshes](const StageRecord& r) { return r.dynamic_factor(r.*meshes); }));
  for (const Kind& kind : kinds)
    add(all, std::string("kv_") + kind.suffix, "1",
        std::string("dynamic factor K_v of the ") + kind.name + " mesh with the largest force",
        Number([meshes = kind.meshes](const StageRecord& r) { return StageRecord::kv(r.*meshes); }));
  for (const Kind& kind : kinds)
    add(all, std::string("k_gamma_") + kind.suffix, "1",
        std::string("mesh load factor K_γ of the ") + kind.name +
            " meshes: largest quasi-static force of any over the mean of all",
        Number([meshes = kind.meshes](const StageRecord& r) { return StageRecord::k_gamma(r.*meshes); }));
  add(all, "force_bearing_max", "N", "largest force of any planet's bearing",
      Number([](const StageRecord& r) { return r.largest_bearing_force(); }));
  add_force(all, "force_sun_bearing", "the force of the sun's bearing (damping in the clearance included)",
            [](const StageRecord& r) -> const Course& { return r.sun_bearing; });
  add(all, "force_max_error", "1",
      "estimated relative error of the largest forces and of K_v by sampling: largest of all meshes and bearings",
      Number([](const StageRecord& r) { return r.force_error; }));
  add(all, "static_force", "N", "static force of a sun mesh: torque over base radius and number of planets",
      Number([](const StageRecord& r) { return r.static_force; }));
  add(all, "mesh_frequency_Hz", "Hz", "mesh frequency",
      Number([](const StageRecord& r) { return r.mesh_frequency / (2.0 * std::numbers::pi); }));
  add(all, "sun_speed_rpm", "rpm", "speed of the sun",
      Number([](const StageRecord& r) { return gear::rpm * r.speeds.sun; }));
  add(all, "carrier_speed_rpm", "rpm", "speed of the carrier",
      Number([](const StageRecord& r) { return gear::rpm * r.speeds.carrier; }));
  return all;
}

KnownLives known_lives(const StageRecord& record) {
  return {!record.planet_lives.empty(), record.sun_life.has_value()};
}

std::vector<StageColumn> life_columns(std::size_t planets, const KnownLives& known) {
  using LifeOf = std::function<gear::BearingLife(const StageRecord&)>;
  std::vector<StageColumn> all;
  const auto add_life = [&all](const std::string& name, const std::string& whose, const LifeOf& of) {
    const auto number = [&](const char* unit, const char* column_unit, const std::string& meaning,
                            double gear::BearingLife::*member) {
      add(all, name + "_" + unit, column_unit, meaning + " of " + whose,
          Number([of, member](const StageRecord& r) { return of(r).*member; }));
    };
    number("load_N", "N", "equivalent load P", &gear::BearingLife::equivalent_load_N);
    number("life_Mrev", "10^6 revolutions", "basic rating life L10", &gear::BearingLife::million_revolutions);
    number("life_h", "h", "basic rating life L10h", &gear::BearingLife::hours);
  };
  if (known.planets)
    add(all, "bearing_life_min_h", "h", "shortest basic rating life L10h of any planet's bearing",
        Number([](const StageRecord& r) { return r.shortest_life(); }));
  if (known.sun)
    add_life("sun_bearing", "the sun's bearing",
             [](const StageRecord& r) { return r.sun_life.value_or(gear::BearingLife()); });
  for (std::size_t i = 0; known.planets && i < planets; ++i)
    add_life("bearing_" + std::to_string(i + 1), "the bearing of planet " + std::to_string(i + 1),
             [i](const StageRecord& r) { return i < r.planet_lives.size() ? r.planet_lives[i] : gear::BearingLife(); });
  return all;
}

std::vector<StageColumn> planet_columns(std::size_t planets) {
  std::vector<StageColumn> all;
  for (const Kind& kind : kinds)
    for (std::size_t i = 0; i < planets; ++i) {
      const std::string suffix = std::string(kind.suffix) + "_" + std::to_string(i + 1);
      const std::string mesh = mesh_words(kind, i);
      const CourseOf delta = course_of(kind, i, &MeshRecord::delta);
      add_extrema(all, "delta_" + suffix, mesh, delta);
      all.push_back(contact_of(kind, suffix, i, mesh));
      add_mean_and_rms(all, "delta_" + suffix, "b_c", "the deflection of " + mesh, delta);
      add_force(all, "force_" + suffix, "the force of " + mesh, course_of(kind, i, &MeshRecord::force));
      const auto share = [&](const char* name, const std::string& meaning, double Course::*member) {
        add(all, name + suffix, "1", meaning + mesh + " over the mean of those of all planets",
            Number([meshes = kind.meshes, i, member](const StageRecord& r) {
              return StageRecord::share(r.*meshes, member, i);
            }));
      };
      share("load_sharing_", "time mean of the force of ", &Course::mean);
      share("load_sharing_max_", "largest force of ", &Course::largest);
      const auto of_mesh = [&](const std::string& name, const char* unit, const std::string& meaning,
                               const std::function<double(const MeshRecord&)>& number) {
        add(all, name, unit, meaning,
            Number([meshes = kind.meshes, i, number](const StageRecord& r) { return number((r.*meshes)[i]); }));
      };
      of_mesh("force_" + suffix + "_quasi_static_max", "N", "largest quasi-static force of " + mesh,
              [](const MeshRecord& r) { return r.quasi_static.largest; });
      of_mesh("kv_" + suffix, "1", "dynamic factor K_v of " + mesh, &MeshRecord::kv);
      of_mesh("drive_time_" + suffix, "part of the time", "time in contact on the drive flank, " + mesh,
              &MeshRecord::drive);
      of_mesh("loss_time_" + suffix, "part of the time", "time out of contact, " + mesh, &MeshRecord::loss);
      of_mesh("back_time_" + suffix, "part of the time", "time in contact on the back flank, " + mesh,
              &MeshRecord::back);
    }
  for (std::size_t i = 0; i < planets; ++i)
    add_force(all, "force_bearing_" + std::to_string(i + 1), "the bearing force of planet " + std::to_string(i + 1),
              [i](const StageRecord& r) -> const Course& { return r.planet_bearing[i]; });
  return all;
}

}  // namespace epicyclic::store
