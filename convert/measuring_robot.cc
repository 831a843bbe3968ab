#include <array>
#include <numbers>

#include "absl/strings/str_cat.h"
#include "convert/run.h"

namespace truepose::convert {
namespace {

constexpr double kDeg = std::numbers::pi / 180;

// Eq. 37 as corrected: theta, d, a, alpha of each link; mm and deg.
constexpr std::array<std::array<double, 4>, 5> kLinks = {{
    {0, 252, 0, 90},
    {0, 0, 320, 0},
    {90, 0, 0, 90},
    {0, 330, 0, 90},
    {-90, 0, 0, 90},
}};
constexpr double kPinLength_m = 0.161;

}  // namespace

v1::Nominal MeasuringRobot() {
  v1::Nominal nominal;
  nominal.set_model("measuring robot of Fassi, Legnani, Tosi and Omodei, Sec. 11");
  nominal.set_kind(v1::MEASURING);
  for (size_t i = 0; i < kLinks.size(); ++i) {
    v1::Joint* joint = nominal.add_joints();
    joint->set_name(absl::StrCat("joint", i + 1));
    joint->set_type(v1::REVOLUTE);
    v1::DhRow* row = nominal.mutable_geometry()->mutable_standard_dh()->add_rows();
    row->set_theta_rad(kLinks[i][0] * kDeg);
    row->set_d_m(kLinks[i][1] / 1e3);
    row->set_a_m(kLinks[i][2] / 1e3);
    row->set_alpha_rad(kLinks[i][3] * kDeg);
  }
  v1::Tool* pin = nominal.add_tools();
  pin->set_name("pin");
  pin->mutable_pose()->set_z_m(kPinLength_m);
  pin->mutable_pose()->set_qw(1);
  return nominal;
}

}  // namespace truepose::convert
