#include "client/download.h"

#include <openssl/sha.h>

#include <thread>

#include "absl/strings/escaping.h"
#include "absl/strings/str_cat.h"
#include "core/base/status_macros.h"

namespace truepose::client {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kPause{200};

std::string Sha256Hex(const std::string& bytes) {
  unsigned char digest[SHA256_DIGEST_LENGTH];
  SHA256(reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size(), digest);
  return absl::BytesToHexString(
      absl::string_view(reinterpret_cast<const char*>(digest), sizeof(digest)));
}

// What has come so far, and of what.
struct Received {
  std::string bytes;
  std::string sha256;
  int64_t total = -1;  // unknown before the first chunk

  int64_t size() const { return static_cast<int64_t>(bytes.size()); }
  bool is_complete() const { return size() == total; }

  absl::Status Take(const v1::DownloadResponse& response) {
    if (response.offset() != size()) {
      return absl::InternalError(absl::StrCat("the server sent byte ", response.offset(),
                                              " where byte ", size(), " comes next"));
    }
    bytes += response.chunk();
    sha256 = response.sha256();
    total = response.total_bytes();
    return absl::OkStatus();
  }
};

// One connection: takes chunks until it ends, from where the others left off.
absl::Status GoOn(const Client& client, const std::string& name, const DownloadOptions& options,
                  Received& received, Clock::time_point& heard) {
  v1::DownloadRequest request;
  request.set_name(name);
  request.set_offset(received.size());
  request.set_sha256(received.sha256.empty() ? options.sha256 : received.sha256);
  absl::Status taken;
  const absl::Status status = client.ReadDownload(request, [&](const auto& response) {
    heard = Clock::now();
    taken = received.Take(response);
    if (options.on_progress) options.on_progress(received.size(), received.total);
    return taken.ok();
  });
  return taken.ok() ? status : taken;
}

// Of the connection, or ended by the server because nothing was taken for long.
bool IsBroken(const absl::Status& status) {
  return absl::IsUnavailable(status) || absl::IsResourceExhausted(status) ||
         absl::IsCancelled(status);
}

}  // namespace

absl::StatusOr<std::string> Download(const Client& client, const std::string& name,
                                     const DownloadOptions& options) {
  Received received;
  Clock::time_point heard = Clock::now();
  while (!received.is_complete()) {
    const absl::Status status = GoOn(client, name, options, received, heard);
    if (absl::IsAborted(status) && !received.sha256.empty()) {
      received = {};
    } else if (IsBroken(status) && !received.sha256.empty() &&
               Clock::now() - heard < options.patience) {
      std::this_thread::sleep_for(kPause);
    } else {
      TRUEPOSE_RETURN_IF_ERROR(status);
      if (!received.is_complete()) return absl::InternalError("a download ended before its end");
    }
  }
  if (Sha256Hex(received.bytes) == received.sha256) return std::move(received.bytes);
  return absl::DataLossError(absl::StrCat("the bytes of ", name, " do not fit their digest"));
}

}  // namespace truepose::client
