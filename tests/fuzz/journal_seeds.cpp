// journal_seeds FOLDER: inputs that the journal's target starts from [journal.cpp].

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "fuzz.hpp"
#include "store/point_record.hpp"

namespace {

using namespace epicyclic;

std::string text_of(const std::vector<std::byte>& bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

std::string piece(int kind, int point, const std::string& bytes) {
  std::string text;
  text += static_cast<char>(kind);
  text += static_cast<char>(point);
  text += static_cast<char>(bytes.size() % 256);
  text += static_cast<char>(bytes.size() / 256);
  return text + bytes;
}

studies::PointResult point() {
  studies::PointResult r;
  r.point = {3, studies::Direction::down, 0.5, 0.1};
  r.message = "none";
  r.regime = analysis::Regime::periodic;
  r.period = 2;
  r.classified = true;
  r.evidence.note = "by Newton's method";
  r.sun_planet.resize(2);
  r.ring_planet.resize(2);
  r.sun_planet[1].loss = true;
  r.end_state = {1, 2, 3, 4};
  r.poincare_columns = 2;
  r.poincare = {1, 2, 3, 4};
  r.attractor.regime = analysis::Regime::periodic;
  r.attractor.dimension = 2;
  r.attractor.orbit = {1, 2, 3, 4};
  return r;
}

studies::TolerancePoint tolerance_point() {
  studies::TolerancePoint t;
  t.study = point();
  t.period = 1;
  t.orbit = {1, 2};
  t.ladder.resize(1);
  t.ladder[0].method = "arkode-dopri5";
  t.smoothing.resize(1);
  t.statistics.resize(1);
  return t;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  const std::filesystem::path folder = argv[1];
  std::filesystem::create_directories(folder);
  const std::string record = text_of(store::encode_point(point()));
  const std::string measured = text_of(store::encode_tolerance_point(tolerance_point()));
  fuzz::put_file(folder / "point", "p" + piece(0, 3, record));
  fuzz::put_file(folder / "measured", "p" + piece(0, 4, measured));
  fuzz::put_file(folder / "two", "p" + piece(0, 3, record) + piece(0, 4, "short"));
  fuzz::put_file(folder / "torn", "p" + piece(0, 3, record) + piece(6, 9, "short"));
  fuzz::put_file(folder / "flipped", "p" + piece(7, 20, record) + piece(0, 4, "short"));
  fuzz::put_file(folder / "tail", "p" + piece(0, 3, "") + piece(5, 0, "EPJR"));
  fuzz::put_file(folder / "payload", "f" + record);
  fuzz::put_file(folder / "file", "fepicyclic-jn" + std::string("\x02\0\0\0", 4) + std::string(64, 'a'));
  return 0;
}
