// Digests cover everything that changes a result, and what is not there leaves them as they were.
#include "convert/digest.h"

#include <gtest/gtest.h>

#include <functional>
#include <set>

#include "tests/convert/samples.h"

namespace truepose::convert {
namespace {

// The lines of docs/formats.md, written again by hand. Catches: a line that comes although nothing
// is there, which would give every stored session another digest.
TEST(Digest, LinesOfAPlainReading) {
  v1::Reading reading;
  reading.add_joints_measured(1);
  reading.set_placement("left");
  EXPECT_EQ(ReadingsDigest({reading}),
            Sha256("row[0].joints_measured[0] 0x1p+0\nrow[0].time \nrow[0].placement left\n"
                   "row[0].target \nrow[0].group \n"));
}

TEST(Digest, LinesOfPlainOptions) {
  v1::CalibrationOptions options;
  options.set_split("even-odd");
  EXPECT_EQ(JobInputDigest("n", {"s"}, options),
            Sha256("nominal n\nsession s\nsplit even-odd\ngroup_column \n"
                   "observe OBSERVE_UNSPECIFIED\nrequire_complete false\nstrict_limits false\n"
                   "model \nestimator \nnominal_tool \n"));
}

TEST(Digest, LinesOfAFurtherReading) {
  v1::Reading reading;
  v1::MeasuredPoint* point = reading.add_points();
  point->set_target("p1");
  point->mutable_position_m()->set_x(2);
  reading.set_distance_m(1);
  reading.set_anchor("A");
  reading.set_feature("f");
  EXPECT_EQ(ReadingsDigest({reading}),
            Sha256("row[0].time \nrow[0].placement \nrow[0].target \nrow[0].group \n"
                   "row[0].points[0].target p1\nrow[0].points[0].position_m.x 0x1p+1\n"
                   "row[0].points[0].position_m.y 0x0p+0\nrow[0].points[0].position_m.z 0x0p+0\n"
                   "row[0].distance_m 0x1p+0\nrow[0].anchor A\nrow[0].feature f\n"));
}

// Each change gives a digest of its own.
template <typename Message>
void ExpectAllDiffer(const std::vector<std::function<void(Message*)>>& changes,
                     const std::function<std::string(const Message&)>& digest) {
  std::set<std::string> digests = {digest(Message())};
  for (const auto& change : changes) {
    Message message;
    change(&message);
    digests.insert(digest(message));
  }
  EXPECT_EQ(digests.size(), changes.size() + 1);
}

// Catches: a repeated job that gets the result of another one.
TEST(Digest, EveryOptionCounts) {
  using Options = v1::CalibrationOptions;
  ExpectAllDiffer<Options>(
      {[](Options* o) { o->set_select("bic"); }, [](Options* o) { o->set_effects("auto"); },
       [](Options* o) { o->set_loss("huber"); }, [](Options* o) { o->set_calibrate("internal"); },
       [](Options* o) { o->set_prior("tolerance"); },
       [](Options* o) { o->mutable_prior_calibration(); },
       [](Options* o) { o->mutable_prior_calibration()->add_covariance(1); },
       [](Options* o) { o->mutable_fixture(); },
       [](Options* o) { o->mutable_fixture()->add_features(); },
       [](Options* o) { o->mutable_fixture()->add_features()->mutable_pose()->set_z_m(1); },
       [](Options* o) { o->mutable_fixture()->add_features()->add_covariance(1); },
       [](Options* o) { o->set_feature_column("hole"); }, [](Options* o) { o->add_joint_sd(1); },
       [](Options* o) { o->set_pose_matching("joint_space"); },
       [](Options* o) { o->set_joints("measured"); }},
      [](const Options& o) { return JobInputDigest("", {}, o); });
}

TEST(Digest, EveryFieldOfAReadingCounts) {
  using R = v1::Reading;
  ExpectAllDiffer<R>(
      {[](R* r) { r->set_coordinates("z"); }, [](R* r) { r->set_distance_m(0); },
       [](R* r) { r->set_distance_sd_m(0); }, [](R* r) { r->set_anchor("a"); },
       [](R* r) { r->set_beam("a"); }, [](R* r) { r->set_feature("a"); },
       [](R* r) { r->add_points(); }, [](R* r) { r->add_points()->set_target("p1"); },
       [](R* r) { r->add_points()->mutable_position_sd_m(); }},
      [](const R& r) { return ReadingsDigest({r}); });
}

TEST(Digest, MassesCount) {
  ExpectAllDiffer<v1::Nominal>({[](v1::Nominal* n) { n->add_masses(); },
                                [](v1::Nominal* n) { n->add_masses()->set_joint(1); },
                                [](v1::Nominal* n) { n->add_masses()->set_mass_kg(1); },
                                [](v1::Nominal* n) { n->add_masses()->set_z_m(1); }},
                               [](const v1::Nominal& n) { return NominalDigest(n); });
}

}  // namespace
}  // namespace truepose::convert
