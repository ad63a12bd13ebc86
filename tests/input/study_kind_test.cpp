#include "input/study_kind.hpp"

#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace epicyclic::input::study_kind_test {
namespace {

/// A name that a program knows, and cannot compute.
const StudyKind& missing_kind() {
  static const StudyKind kind = {.name = "elsewhere", .commands = "", .missing = "it is built without it"};
  static const bool added = (add_kind(kind), true);
  (void)added;
  return kind;
}

TEST(StudyKinds, ThatAreMissingAreRefusedWithTheReasonAlone) {
  (void)missing_kind();
  const nlohmann::json whole = {{"stage", nlohmann::json::object()}, {"study", {{"kind", "elsewhere"}, {"any", 1}}}};
  ReadContext context;
  Study study;
  study_table().read(whole, "", study, context);
  std::erase_if(context.findings, [](const Finding& f) { return !f.pointer.starts_with("/study"); });
  ASSERT_EQ(context.findings.size(), 1U);
  EXPECT_EQ(context.findings[0].pointer, "/study/kind");
  EXPECT_EQ(context.findings[0].message, "is \"elsewhere\": it is built without it");
  EXPECT_FALSE(study.has_dynamics());
}

TEST(StudyKinds, ThatAreMissingHaveNoKeys) {
  (void)missing_kind();
  EXPECT_EQ(schema_text().find("elsewhere"), std::string::npos);
}

}  // namespace
}  // namespace epicyclic::input::study_kind_test
