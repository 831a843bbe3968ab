// What clients do to a server that may be killed at any moment: each effect is asked for until it
// is answered, always by the same request, and is counted when it was. Afterwards the server must
// hold each of them once.
//
// All of them work on robots/arm, and run until `stop`. They want a server to come back within half
// a minute.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "grpcpp/channel.h"
#include "truepose/v1/services.pb.h"
#include "truepose/v1/watch.pb.h"

namespace truepose::testing {

// A channel that finds a server again within milliseconds.
std::shared_ptr<grpc::Channel> ImpatientChannel(const std::string& address);

struct Stop {
  std::atomic<bool> now = false;
};

// Approves a calibration; a failure fails the test.
void Approve(const std::string& address, const v1::ApproveCalibrationRequest& request);

// Uploads readings of `source` (a number) into session `session`, over one stream after another.
// @returns how many were acknowledged.
int64_t UploadReadings(const std::string& address, int source, int session, const Stop& stop);
// Creates, changes, deletes and undeletes instruments "i-1", "i-2", ...
// @returns how many went through all four.
int64_t ChangeInstruments(const std::string& address, const Stop& stop);
// Creates instrument "w-`writer`" and changes it until it has had `changes` events; its display
// name is as long as asked for. Writers count from 0, at most 99.
void ChangeOneInstrument(const std::string& address, int writer, int changes, int name_bytes = 8);
// Makes calibrations 1 and 2 active in turn, which both have to be approved. @returns how often.
int64_t ActivateInTurn(const std::string& address, const Stop& stop);
// Creates jobs over `session` and waits for each. @returns their names.
std::vector<std::string> RunJobs(const std::string& address, int session, const Stop& stop);

// Every event after `revision`, in order, as a watch tells it. A failure fails the test.
std::vector<v1::WatchEvent> EventsAfter(const std::string& address, int64_t revision);

}  // namespace truepose::testing
