// Readings that tell their number, and a disk that fails when it is told to.
#pragma once

#include <cerrno>
#include <cmath>
#include <string>
#include <vector>

#include "client/agent/spool/disk.h"
#include "truepose/v1/session.pb.h"

namespace truepose::agent::testing {

inline v1::Reading Numbered(int64_t number) {
  v1::Reading reading;
  for (int joint = 0; joint < 6; ++joint) reading.add_joints_measured(0.1 * joint);
  reading.mutable_position_m()->set_x(1e-6 * static_cast<double>(number));
  return reading;
}

inline std::vector<v1::Reading> Numbered(int64_t first, int64_t last) {
  std::vector<v1::Reading> readings;
  for (int64_t number = first; number <= last; ++number) readings.push_back(Numbered(number));
  return readings;
}

inline int64_t NumberOf(const v1::Reading& reading) {
  return std::llround(1e6 * reading.position_m().x());
}

inline v1::Session Content(const std::string& id) {
  v1::Session content;
  content.set_name("sessions/" + id);
  content.set_robot("robots/arm");
  return content;
}

inline const char kSession[] = "00000000-0000-4000-8000-000000000001";

// Fails the calls while `countdown` is 0, and counts it down before.
class FaultyDisk : public Disk {
 public:
  ssize_t Write(int descriptor, std::string_view bytes, off_t offset) override {
    if (!Fails()) return Disk::Write(descriptor, bytes, offset);
    // Half of it gets there, as on a disk that runs full.
    Disk::Write(descriptor, bytes.substr(0, bytes.size() / 2), offset);
    errno = error;
    return -1;
  }
  ssize_t Read(int descriptor, char* bytes, size_t size, off_t offset) override {
    if (offset + static_cast<off_t>(size) <= readable) {
      return Disk::Read(descriptor, bytes, size, offset);
    }
    if (offset < readable) {
      return Disk::Read(descriptor, bytes, static_cast<size_t>(readable - offset), offset);
    }
    errno = EIO;
    return -1;
  }
  int Sync(int descriptor) override { return Fails() ? -1 : Disk::Sync(descriptor); }
  int Truncate(int descriptor, off_t size) override {
    return Fails() ? -1 : Disk::Truncate(descriptor, size);
  }

  int countdown = 1 << 30;
  int failures = 1 << 30;  // after so many, all is well again
  int error = ENOSPC;
  off_t readable = off_t{1} << 40;  // what is behind it is a bad sector

 private:
  bool Fails() {
    if (countdown > 0) return --countdown, false;
    if (failures <= 0) return false;
    --failures;
    errno = error;
    return true;
  }
};

}  // namespace truepose::agent::testing
