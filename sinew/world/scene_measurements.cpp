#include "sinew/world/scene_measurements.h"

#include <fmt/format.h>

#include <utility>

#include "sinew/world/state.h"

namespace sinew::world {
namespace {

using graph::Id;

struct ModelReader {
  SceneNumbers& numbers;
  const Edit& edit;
  model::GraphReader& reader = numbers.reader;

  Id w(std::string_view term) { return numbers.w(term); }

  // A twist, or how it changes.
  std::optional<Twist> twist(Id node, std::string_view angular_term, std::string_view linear_term,
                             const data::Dimension& of_angles, const data::Dimension& of_lengths) {
    const auto angular = numbers.vector(node, w(angular_term));
    const auto linear = numbers.vector(node, w(linear_term));
    const auto angles = reader.scale(node, of_angles, "the angular motion");
    const auto lengths = reader.scale(node, of_lengths, "the linear motion");
    if (!angular || !linear || !angles || !lengths) return std::nullopt;
    return Twist{*angles * *angular, *lengths * *linear};
  }
  std::optional<Twist> velocity(Id node) {
    return twist(node, "angular", "linear", model::dimension::kAngularVelocity,
                 model::dimension::kVelocity);
  }

  std::optional<PredictionModel> prediction(Id node, const Measured& measured) {
    const FrameId with_respect_to = measured.with_respect_to;
    const auto model = reader.one(node, w("predicted-by"), "the model of a prediction");
    if (!model) return std::nullopt;
    const bool of_pose = measured.quantity == Quantity::kPose;
    if (reader.is_a(*model, w("ConstantVelocity"))) {
      ConstantVelocity constant;
      if (numbers.has(*model, "angular") || numbers.has(*model, "linear")) {
        const auto stated = velocity(*model);
        if (!stated) return std::nullopt;
        constant.twist = *stated;
      }
      if (numbers.has(*model, "rates")) {
        auto rates = numbers.si_list(*model, "rates", measured.size);
        if (!rates) return std::nullopt;
        constant.rates = std::move(*rates);
      }
      return constant;
    }
    if (reader.is_a(*model, w("ConstantAcceleration"))) {
      ConstantAcceleration faster;
      if (of_pose) {
        const auto stated = velocity(*model);
        const auto rate =
            twist(*model, "angular-rate", "linear-rate", model::dimension::kAngularAcceleration,
                  model::dimension::kAcceleration);
        if (!stated || !rate) return std::nullopt;
        faster.twist = *stated;
        faster.twist_rate = *rate;
        return faster;
      }
      auto rates = numbers.si_list(*model, "rates", measured.size);
      auto accelerations = numbers.si_list(*model, "accelerations", measured.size);
      if (!rates || !accelerations) return std::nullopt;
      faster.rates = std::move(*rates);
      faster.accelerations = std::move(*accelerations);
      return faster;
    }
    if (reader.is_a(*model, w("Conveyor"))) {
      const auto linear = numbers.vector(*model, w("linear"));
      const auto scale =
          reader.scale(*model, model::dimension::kVelocity, "the conveyor's velocity");
      const auto seen_by = reader.one(*model, reader.ids.seen_by, "the frame of the velocity");
      if (!linear || !scale || !seen_by) return std::nullopt;
      if (edit.find_frame(reader.text(*seen_by)) != with_respect_to) {
        reader.error(*model, reader.ids.seen_by,
                     "the velocity is seen by " + numbers.text(*seen_by),
                     "by the frame with respect to which the pose is measured");
        return std::nullopt;
      }
      return Conveyor{*scale * *linear};
    }
    reader.error(node, w("predicted-by"), numbers.text(*model) + " is no model of prediction",
                 "a ConstantVelocity, a ConstantAcceleration or a Conveyor; others are in code");
    return std::nullopt;
  }

  std::optional<LifeCycle> life_cycle(Id node, const Measured& measured) {
    const auto kind = reader.one(node, w("life-cycle"), "how long the measurement holds");
    const auto validity = numbers.duration(node, "validity");
    const auto horizon = numbers.duration(node, "horizon");
    const auto expiry = numbers.stamp(node, "expiry");
    if (!kind || !validity || !horizon || !expiry) return std::nullopt;
    if (reader.text(*kind) != "prediction" &&
        (numbers.has(node, "predicted-by") || numbers.has(node, "horizon"))) {
      reader.error(node, w("life-cycle"),
                   "a model of prediction for a measurement that is " + numbers.text(*kind),
                   "the life-cycle prediction");
      return std::nullopt;
    }
    if (reader.text(*kind) == "static") return Static{};
    if (reader.text(*kind) == "time-dependent") {
      return TimeDependent{.validity = *validity,
                           .expiry = numbers.has(node, "expiry") ? *expiry : Stamp::max()};
    }
    if (reader.text(*kind) == "prediction") {
      auto model = prediction(node, measured);
      if (!model) return std::nullopt;
      return Prediction{.model = std::move(*model), .horizon = *horizon};
    }
    reader.error(node, w("life-cycle"),
                 "there is no life-cycle '" + numbers.text(*kind) + "' in models",
                 "static, time-dependent or prediction");
    return std::nullopt;
  }

  std::optional<Interpolation> interpolation(Id node) {
    if (!numbers.has(node, "interpolation")) return Interpolation::kLinear;
    const auto name = reader.one(node, w("interpolation"), "the interpolation");
    if (!name) return std::nullopt;
    if (reader.text(*name) == "linear") return Interpolation::kLinear;
    if (reader.text(*name) == "screw") return Interpolation::kScrew;
    if (reader.text(*name) == "hold") return Interpolation::kHold;
    reader.error(node, w("interpolation"),
                 "there is no interpolation '" + numbers.text(*name) + "'",
                 "linear, screw or hold");
    return std::nullopt;
  }

  // The deviation by which Choice::kMostCertain and Way::kMostCertain compare, in metres.
  std::optional<double> deviation(Id node) {
    if (!numbers.has(node, "deviation")) return MeasurementModel{}.standard_deviation;
    const auto value = reader.one(node, w("deviation"), "the standard deviation");
    if (!value) return std::nullopt;
    const auto number = reader.number(*value, w("number"));
    const auto scale = reader.scale(*value, model::dimension::kLength, "the standard deviation");
    if (!number || !scale) return std::nullopt;
    if (*number < 0) {
      reader.error(*value, w("number"), fmt::format("a deviation of {}", *number),
                   "none is below zero");
      return std::nullopt;
    }
    return *scale * *number;
  }

  std::optional<MeasurementModel> model_of(Id node, const Measured& measured) {
    const auto cycle = life_cycle(node, measured);
    const auto period = numbers.duration(node, "period");
    const auto provenance = reader.one(node, w("provenance"), "who provides the measurement");
    const auto between = interpolation(node);
    const auto standard_deviation = deviation(node);
    if (!cycle || !period || !provenance || !between || !standard_deviation) return std::nullopt;
    MeasurementModel model{.life_cycle = *cycle,
                           .interpolation = *between,
                           .provenance = numbers.text(*provenance),
                           .standard_deviation = *standard_deviation,
                           .period = *period};
    for (const Id user : reader.objects(node, w("used-by")))
      model.used_by.push_back(numbers.text(user));
    if (const Id seen_from = reader.view.object(node, w("coord-frame"))) {
      model.coord_frame = numbers.text(seen_from);
    }
    return model;
  }
};

}  // namespace

std::optional<Measured> read_measured(SceneNumbers& numbers, Id node, FrameId of,
                                      FrameId with_respect_to) {
  model::GraphReader& reader = numbers.reader;
  Measured measured{.of = of, .with_respect_to = with_respect_to};
  if (!numbers.has(node, "quantity")) return measured;
  const auto name = reader.one(node, numbers.w("quantity"), "the quantity");
  if (!name) return std::nullopt;
  for (const Quantity each :
       {Quantity::kPose, Quantity::kTwist, Quantity::kAcceleration, Quantity::kJointPosition,
        Quantity::kJointVelocity, Quantity::kJointAcceleration, Quantity::kOther}) {
    if (reader.text(*name) != to_string(each)) continue;
    measured.quantity = each;
    measured.size = size_of(each);
    if (each != Quantity::kOther) return measured;
    const auto stated = reader.one(node, numbers.w("size"), "how many numbers it has");
    if (!stated) return std::nullopt;
    const auto size = reader.view.terms().integer_value(*stated);
    if (size && *size >= 1 && *size <= std::int64_t{kMaximumValues}) {
      measured.size = static_cast<std::uint32_t>(*size);
      return measured;
    }
    reader.error(node, numbers.w("size"), numbers.text(*stated) + " numbers",
                 "an integer from 1 to " + std::to_string(kMaximumValues));
    return std::nullopt;
  }
  reader.error(node, numbers.w("quantity"), "there is no quantity '" + numbers.text(*name) + "'",
               "pose, twist, acceleration, joint-position, joint-velocity, joint-acceleration or "
               "other");
  return std::nullopt;
}

std::optional<std::uint32_t> read_entries(SceneNumbers& numbers, Id node, bool is_static) {
  model::GraphReader& reader = numbers.reader;
  if (!numbers.has(node, "entries")) return is_static ? 1 : kUsualCapacity;
  const auto literal =
      reader.one(node, numbers.w("entries"), "the number of entries that are kept");
  if (!literal) return std::nullopt;
  const auto count = reader.view.terms().integer_value(*literal);
  if (count && *count >= 1 && *count <= std::int64_t{kMaximumCapacity}) {
    return static_cast<std::uint32_t>(*count);
  }
  reader.error(node, numbers.w("entries"), numbers.text(*literal) + " entries are kept",
               "an integer from 1 to " + std::to_string(kMaximumCapacity));
  return std::nullopt;
}

std::optional<MeasurementModel> read_measurement_model(SceneNumbers& numbers, const Edit& edit,
                                                       Id node, const Measured& measured) {
  return ModelReader{numbers, edit}.model_of(node, measured);
}

}  // namespace sinew::world
