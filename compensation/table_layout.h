// The bytes of a table's file before its nodes, described once: VisitTable takes every field in the
// order of the file to a visitor, which writes it, reads it or lists it (docs/formats.md).
//
// A visitor has U32, U64, I64, F64, Flag (0 or 1 as U32), Mask (the first so many flags as the low
// bits of a U32), Name (a text of kNameBytes, zeros behind it), Raw (bytes as they are) and Skip
// (bytes that are zero), each with the field's name.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "compensation/table.h"

namespace truepose::compensation {

static_assert(std::endian::native == std::endian::little,
              "nodes are used as they lie in the file, which is little-endian");

inline constexpr std::size_t kNameBytes = 192;
// Not text to any tool: a transfer that changes line ends or strips the eighth bit is noticed.
inline constexpr std::array<std::uint8_t, 8> kTableMagic = {0x89, 'T',  'P',  'C',
                                                            '\r', '\n', 0x1a, '\n'};
inline constexpr std::size_t kDigestAt = 24;   // of the SHA-256 of all other bytes
inline constexpr std::size_t kFieldsAt = 56;   // the first field behind it
inline constexpr std::size_t kNodesAt = 7552;  // a multiple of 64

// The first bytes, which say how to read the rest.
struct TablePrologue {
  std::array<std::uint8_t, 8> magic = kTableMagic;
  std::uint32_t schema = kTableSchema;
  std::uint32_t nodes_at = kNodesAt;
  std::uint64_t total_bytes = 0;
  Digest digest{};
};

template <class Visitor, class Prologue>
void VisitPrologue(Visitor& visit, Prologue& prologue) {
  visit.Raw("magic", prologue.magic);
  visit.U32("schema", prologue.schema);
  visit.U32("nodes_at", prologue.nodes_at);
  visit.U64("total_bytes", prologue.total_bytes);
  visit.Raw("digest", prologue.digest);
}

template <class Visitor, class Error>
void VisitError(Visitor& visit, const char* position, const char* rotation, Error& error) {
  visit.F64(position, error.position_m);
  visit.F64(rotation, error.rotation_rad);
}

template <class Visitor, class Header>
void VisitHeader(Visitor& visit, Header& header) {
  visit.Name("robot", header.robot);
  visit.Name("serial", header.serial);
  visit.Name("calibration", header.calibration);
  visit.Raw("calibration_digest", header.calibration_digest);
  visit.Raw("nominal_digest", header.nominal_digest);
  visit.I64("created_us", header.created_us);
  visit.U32("joints", header.joints);
  visit.U32("verification_points", header.verification_points);
  VisitError(visit, "tolerance_position_m", "tolerance_rotation_rad", header.tolerance);
  VisitError(visit, "worst_position_m", "worst_rotation_rad", header.worst);
  VisitError(visit, "percentile_95_position_m", "percentile_95_rotation_rad", header.percentile_95);
  VisitError(visit, "estimated_worst_position_m", "estimated_worst_rotation_rad",
             header.estimated_worst);
  visit.F64("predicted_accuracy_95_m", header.predicted_accuracy_95_m);
  visit.F64("near_singular_share", header.near_singular_share);
  visit.F64("smallest_singular_value", header.smallest_singular_value);
  visit.F64("characteristic_length_m", header.characteristic_length_m);
}

// Places of an array beyond `count` are zero.
template <class Visitor, class Array, class VisitOne>
void VisitSlots(Visitor& visit, Array& array, int count, std::size_t bytes, VisitOne visit_one) {
  for (int i = 0; i < static_cast<int>(array.size()); ++i) {
    if (i < count) {
      visit_one(array[i]);
    } else {
      visit.Skip("unused", bytes);
    }
  }
}

template <class Visitor, class PoseType>
void VisitPose(Visitor& visit, PoseType& pose) {
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) visit.F64("R", pose.R(row, column));
  }
  for (int row = 0; row < 3; ++row) visit.F64("p", pose.p(row));
}

template <class Visitor, class Chain>
void VisitChain(Visitor& visit, Chain& chain, int joints) {
  visit.Mask("prismatic", chain.prismatic, joints);
  visit.Skip("reserved", 4);
  VisitSlots(visit, chain.constant, joints + 1, 12 * 8,
             [&](auto& pose) { VisitPose(visit, pose); });
}

template <class Visitor, class ArmType>
void VisitJointMap(Visitor& visit, ArmType& arm, int joints) {
  for (int row = 0; row < kMaxJoints; ++row) {
    for (int column = 0; column < kMaxJoints; ++column) {
      if (row < joints && column < joints) {
        visit.F64("joint_scale", arm.joint_scale(row, column));
      } else {
        visit.Skip("unused", 8);
      }
    }
  }
  for (int row = 0; row < kMaxJoints; ++row) {
    if (row < joints) {
      visit.F64("joint_offset", arm.joint_offset(row));
    } else {
      visit.Skip("unused", 8);
    }
  }
}

template <class Visitor, class Effect>
void VisitEffect(Visitor& visit, Effect& effect) {
  visit.F64("gain", effect.gain);
  for (auto& value : effect.cosine) visit.F64("cosine", value);
  for (auto& value : effect.sine) visit.F64("sine", value);
  visit.F64("compliance", effect.compliance);
}

template <class Visitor, class Mass>
void VisitMass(Visitor& visit, Mass& mass) {
  visit.U32("joint", mass.joint);
  visit.Skip("reserved", 4);
  visit.F64("mass_kg", mass.mass_kg);
  for (int row = 0; row < 3; ++row) visit.F64("centre_B", mass.centre_B(row));
}

template <class Visitor, class ArmType>
void VisitArm(Visitor& visit, ArmType& arm, int joints) {
  visit.Flag("measuring", arm.measuring);
  visit.U32("masses", arm.masses);
  VisitChain(visit, arm.nominal, joints);
  VisitChain(visit, arm.identified, joints);
  VisitJointMap(visit, arm, joints);
  VisitSlots(visit, arm.limits, joints, 16, [&](auto& limits) {
    visit.F64("lower", limits.lower);
    visit.F64("upper", limits.upper);
  });
  VisitSlots(visit, arm.effects, joints, 48, [&](auto& effect) { VisitEffect(visit, effect); });
  VisitSlots(visit, arm.mass, arm.masses, 40, [&](auto& mass) { VisitMass(visit, mass); });
}

template <class Visitor, class Axis>
void VisitAxis(Visitor& visit, Axis& axis, int joints) {
  VisitSlots(visit, axis.weight, joints, 8, [&](auto& weight) { visit.F64("weight", weight); });
  visit.F64("lower", axis.lower);
  visit.F64("upper", axis.upper);
  visit.F64("margin", axis.margin);
  visit.U32("nodes", axis.nodes);
  visit.Skip("reserved", 4);
}

// All fields between the prologue and the nodes. The counts joints and masses are taken where they
// have been visited; a reader's visitor holds them to what there is room for.
template <class Visitor, class Header, class ArmType, class Axes>
void VisitFields(Visitor& visit, Header& header, ArmType& arm, Axes& axes) {
  VisitHeader(visit, header);
  const int joints = header.joints;
  VisitArm(visit, arm, joints);
  VisitSlots(visit, axes, joints, 128, [&](auto& axis) { VisitAxis(visit, axis, joints); });
  visit.Skip("padding", 32);  // to kNodesAt
}

}  // namespace truepose::compensation
