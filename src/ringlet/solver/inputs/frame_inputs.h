// FrameInputs: everything that acts on one head's hair from outside.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <tuple>
#include <utility>

#include "ringlet/base/result.h"
#include "ringlet/gpu/device.h"
#include "ringlet/rest/goal.h"
#include "ringlet/rest/goal_units.h"
#include "ringlet/rest/rest_state.h"
#include "ringlet/solver/features.h"
#include "ringlet/solver/inputs/air_input.h"
#include "ringlet/solver/inputs/bodies_input.h"
#include "ringlet/solver/inputs/fallen_hair.h"
#include "ringlet/solver/inputs/fields_input.h"
#include "ringlet/solver/inputs/forces_input.h"
#include "ringlet/solver/inputs/frame_input.h"
#include "ringlet/solver/inputs/goals_input.h"
#include "ringlet/solver/inputs/head_input.h"
#include "ringlet/solver/inputs/head_places.h"
#include "ringlet/solver/inputs/numbers_input.h"
#include "ringlet/solver/inputs/rigid_hair.h"
#include "ringlet/solver/inputs/roots_input.h"
#include "ringlet/solver/plan/groom_chunks.h"

namespace ringlet {

struct InitialState;

/// What inputs are made from. All of it must outlive them, except `initial`.
struct InputSource {
  gpu::Device& device;
  const RestState& rest;
  const Settings& settings;  // the asset's: no frame has more steps than these say
  Features features{};       // that the hair uses
  std::span<const GroomChunk> chunks;
  const GroomGoal* goal = nullptr;        // of the groom; null: none
  std::span<const GoalUnit> goalUnits{};  // with goals, of each particle, device order
  const InitialState& initial;
  const std::optional<HeadPlace>& place;  // if the head shares buffers with others
  std::size_t slots = 0;                  // frames in flight
};

class FrameInputs {
  // Each has `static Result<Input> create(const InputSource&)`.
  template <class... Input>
  using ListOf = std::tuple<std::optional<Input>...>;
  using List = ListOf<NumbersInput, HeadInput, BodiesInput, AirInput, RootsInput, ForcesInput, GoalsInput,
                      FieldsInput, RigidHair, FallenHair>;
  static constexpr std::size_t kCount = std::tuple_size_v<List>;

 public:
  /// Fails on invalid bodies, and when the device lacks memory.
  static Result<FrameInputs> create(const InputSource& from) {
    FrameInputs self;
    Status made;
    const auto make = [&]<class Input>(std::optional<Input>& input) {
      auto created = Input::create(from);
      if (created) {
        input.emplace(std::move(*created));
      } else {
        made = created.error();
      }
      return bool(made);
    };
    std::apply([&](auto&... input) { static_cast<void>((make(input) && ...)); }, self.list_);
    if (!made) return made.error();
    return self;
  }

  template <class Input>
  Input& get() {
    return *std::get<std::optional<Input>>(list_);
  }
  template <class Input>
  const Input& get() const {
    return *std::get<std::optional<Input>>(list_);
  }
  std::array<FrameInput*, kCount> each() {
    return std::apply([](auto&... input) { return std::array<FrameInput*, kCount>{&*input...}; }, list_);
  }
  std::array<const FrameInput*, kCount> each() const {
    return std::apply([](const auto&... input) { return std::array<const FrameInput*, kCount>{&*input...}; },
                      list_);
  }

 private:
  FrameInputs() = default;

  List list_;
};

}  // namespace ringlet
