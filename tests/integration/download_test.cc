// Downloads over a real server: whole, resumed, and refused.
#include "client/download.h"

#include "absl/strings/str_cat.h"
#include "client/wait_for_job.h"
#include "client/watch.h"
#include "convert/run.h"
#include "tests/integration/server_fixture.h"
#include "tests/server/testing/expect_status.h"

namespace truepose {
namespace {

using testing::HasCode;
using testing::Import;
using testing::IsOk;
using testing::MeasuringSession;
using testing::Uuid;

class DownloadTest : public testing::ServerFixture {
 protected:
  // About 130 bytes a reading: several chunks.
  static constexpr int kPoses = 6'000;
  // More than connections take from a server while nobody reads (4.2 MB).
  static constexpr int kPosesBeyondBuffers = 60'000;

  void ImportBig(int poses = kPoses) {
    input_ = MeasuringSession(poses, 1);
    Import(NewClient(), "arm", Uuid(1), input_);
  }

  v1::DownloadRequest Request(int64_t offset, const std::string& sha256 = "") const {
    v1::DownloadRequest request;
    request.set_name(name_);
    request.set_offset(offset);
    request.set_sha256(sha256);
    return request;
  }

  // All chunks from an offset.
  std::vector<v1::DownloadResponse> Chunks(const v1::DownloadRequest& request) const {
    std::vector<v1::DownloadResponse> chunks;
    const absl::Status status = NewClient().ReadDownload(request, [&](const auto& chunk) {
      chunks.push_back(chunk);
      return true;
    });
    EXPECT_THAT(status, IsOk());
    return chunks;
  }
  absl::Status Refused(const v1::DownloadRequest& request) const {
    return NewClient().ReadDownload(request, [](const auto&) { return true; });
  }

  const std::string name_ = absl::StrCat("sessions/", Uuid(1));
  v1::SessionInput input_;
};

// Would catch readings that are lost, doubled or changed on the way, and a digest of other bytes.
TEST_F(DownloadTest, ASessionComesWholeAndAsItWasSealed) {
  ImportBig();
  const auto bytes = client::Download(NewClient(), name_);
  ASSERT_THAT(bytes, IsOk());
  v1::SessionInput got;
  ASSERT_TRUE(got.ParseFromString(*bytes));
  ASSERT_EQ(got.readings_size(), kPoses);
  EXPECT_EQ(got.readings(kPoses - 1).SerializeAsString(),
            input_.readings(kPoses - 1).SerializeAsString());
  EXPECT_EQ(convert::ReadingsDigest({got.readings().begin(), got.readings().end()}),
            got.session().digest());
}

// Would catch chunks of another size, or ones that do not follow each other.
TEST_F(DownloadTest, ChunksAreOf256KiBAndFollowEachOther) {
  ImportBig();
  const auto chunks = Chunks(Request(0));
  ASSERT_GE(chunks.size(), 3u);
  int64_t next = 0;
  for (size_t i = 0; i < chunks.size(); ++i) {
    EXPECT_EQ(chunks[i].offset(), next);
    EXPECT_EQ(chunks[i].sha256(), chunks[0].sha256());
    const bool last = i + 1 == chunks.size();
    EXPECT_TRUE(last || chunks[i].chunk().size() == 256u << 10) << chunks[i].chunk().size();
    next += static_cast<int64_t>(chunks[i].chunk().size());
  }
  EXPECT_EQ(next, chunks[0].total_bytes());
}

// Would catch an offset that is taken from the chunk's beginning, and an end that is an error.
TEST_F(DownloadTest, AnyOffsetGoesOnThere) {
  ImportBig();
  const auto whole = client::Download(NewClient(), name_);
  ASSERT_THAT(whole, IsOk());
  const auto size = static_cast<int64_t>(whole->size());
  for (const int64_t offset : {int64_t{1}, int64_t{300'001}, size - 1, size}) {
    std::string rest;
    for (const v1::DownloadResponse& chunk : Chunks(Request(offset))) rest += chunk.chunk();
    EXPECT_EQ(rest, whole->substr(offset)) << offset;
  }
  EXPECT_THAT(Refused(Request(size + 1)), HasCode(absl::StatusCode::kOutOfRange));
  EXPECT_THAT(Refused(Request(-1)), HasCode(absl::StatusCode::kInvalidArgument));
}

// Would catch a download that begins again, or gives up, when the server is started again in the
// middle of it.
TEST_F(DownloadTest, GoesOnOverARestartOfTheServer) {
  ImportBig(kPosesBeyondBuffers);
  const auto whole = client::Download(NewClient(), name_);
  ASSERT_THAT(whole, IsOk());
  bool restarted = false;
  int64_t most = 0;
  const auto again =
      client::Download(NewClient(), name_, {.on_progress = [&](int64_t have, int64_t) {
                         EXPECT_GT(have, most) << "bytes came twice";
                         most = have;
                         if (!std::exchange(restarted, true)) Restart();
                       }});
  ASSERT_THAT(again, IsOk());
  EXPECT_EQ(*again, *whole);
}

// Would catch bytes of two states glued together.
TEST_F(DownloadTest, OtherBytesThanBeforeAreAborted) {
  ImportBig();
  EXPECT_THAT(Refused(Request(0, std::string(64, '0'))), HasCode(absl::StatusCode::kAborted));
}

// Would catch readings of a session that may still change, and a name that is looked for in vain.
TEST_F(DownloadTest, RefusesWhatIsOpenOrNotThere) {
  Import(NewClient(), "arm", Uuid(2), MeasuringSession(20, 1));
  v1::CreateSessionRequest open;
  open.set_session_id(Uuid(1));
  open.mutable_session()->set_robot("robots/arm");
  ASSERT_THAT(NewClient().CreateSession(open), IsOk());
  EXPECT_THAT(Refused(Request(0)), HasCode(absl::StatusCode::kFailedPrecondition));
  v1::DownloadRequest request;
  for (const std::string& unknown :
       {"sessions/" + Uuid(9), std::string("robots/arm/calibrations/9")}) {
    request.set_name(unknown);
    EXPECT_THAT(Refused(request), HasCode(absl::StatusCode::kNotFound)) << unknown;
  }
  for (const char* malformed : {"", "robots/arm", "/etc/passwd", "http://127.0.0.1/"}) {
    request.set_name(malformed);
    EXPECT_THAT(Refused(request), HasCode(absl::StatusCode::kInvalidArgument)) << malformed;
  }
}

// Would catch a calibration without its residuals or covariance, or with other bits.
TEST_F(DownloadTest, ACalibrationIsThatOfGet) {
  Import(NewClient(), "arm", Uuid(1), MeasuringSession(200, 1));
  ASSERT_THAT(NewClient().CreateCalibrationJob(testing::JobRequest(Uuid(7), "arm", Uuid(1))),
              IsOk());
  const auto job = client::WaitForJob(NewClient(), absl::StrCat("jobs/", Uuid(7)));
  ASSERT_THAT(job, IsOk());
  v1::GetCalibrationRequest get;
  get.set_name(job->calibration());
  const auto got = NewClient().GetCalibration(get);
  ASSERT_THAT(got, IsOk());
  const auto bytes = client::Download(NewClient(), get.name());
  ASSERT_THAT(bytes, IsOk());
  v1::Calibration downloaded;
  ASSERT_TRUE(downloaded.ParseFromString(*bytes));
  EXPECT_EQ(downloaded.SerializeAsString(), got->SerializeAsString());
  EXPECT_GT(downloaded.residuals_size(), 0);
  EXPECT_GT(downloaded.covariance_size(), 0);
}

}  // namespace
}  // namespace truepose
