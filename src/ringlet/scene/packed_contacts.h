// What the contact kernels get of the settings. It is written beside the table of these (contact_fields.cpp),
// so that a setting that goes to the device is said in one file.
#pragma once

#include "layout/contacts.h"
#include "ringlet/scene/contact_settings.h"

namespace ringlet {

/// The parameters that follow from settings and the step alone [s]; all others, which are sizes of buffers
/// and the like, are 0.
layout::ContactParameters packed(const ContactSettings& settings, double stepSeconds);

}  // namespace ringlet
