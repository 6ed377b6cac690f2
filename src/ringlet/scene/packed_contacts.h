// Packs contact settings for the kernels. It is implemented beside the table of these settings
// (contact_fields.cpp), so that one file says all about a setting.
#pragma once

#include "layout/contacts.h"
#include "ringlet/scene/contact_settings.h"

namespace ringlet {

/// The parameters that follow from settings and the step alone [s]; all others, which are sizes of buffers
/// and the like, are 0.
layout::ContactNumbers packed(const ContactSettings& settings, double stepSeconds);

}  // namespace ringlet
