// SQLite on a SimulatedDisk: the files are real, and every change of them is told to the model
// first.
#pragma once

#include <memory>

#include "tests/store/power/simulated_disk.h"

namespace truepose::store {

// While it lives every connection that is opened in this process goes over `disk`. One at a time;
// connections must be closed before it is destroyed. Shared memory (-shm) is no file of the disk:
// SQLite makes it anew.
class PowerVfs {
 public:
  explicit PowerVfs(SimulatedDisk& disk);
  ~PowerVfs();
  PowerVfs(const PowerVfs&) = delete;
  PowerVfs& operator=(const PowerVfs&) = delete;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace truepose::store
