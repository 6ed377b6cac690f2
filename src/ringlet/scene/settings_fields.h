// The settings of a run, of contacts and of the air, each once.
#pragma once

#include <span>
#include <string>

#include "ringlet/base/result.h"
#include "ringlet/scene/air.h"
#include "ringlet/scene/contact_settings.h"
#include "ringlet/scene/setting_field.h"
#include "ringlet/scene/settings.h"

namespace ringlet {

/// All but the integrator, contacts and air.
std::span<const SettingField<Settings>> settingsFields();
std::span<const SettingField<ContactSettings>> contactFields();
std::span<const SettingField<AirSettings>> airFields();
std::span<const SettingField<GoalSettings>> goalFields();

/// The sentence that says which number is out of its range, if any is.
Status checkNumbers(const Settings& settings);
Status checkNumbers(const ContactSettings& settings);

/// The first setting that differs and may not change while hair moves ("contacts.radius"); "" for none.
std::string fixedDifference(const Settings& a, const Settings& b);
std::string fixedDifference(const ContactSettings& a, const ContactSettings& b);
std::string fixedDifference(const AirSettings& a, const AirSettings& b);
std::string fixedDifference(const GoalSettings& a, const GoalSettings& b);

}  // namespace ringlet
