// How a way is followed to a surface, and what comes of keeping a particle out of it. Mirrored by
// reference/equations/body_contact.h.
#ifndef RINGLET_KEPT_OUT
#define RINGLET_KEPT_OUT

const float kTouchDistance = 1e-5;  // [m]: closer counts as touching; a tenth of a hair
const int kTraceTurns = 16;         // distances taken along a path; grazing paths use them up and count as
                                    // touching

/// Where a particle is put, and along which normal; moved: whether it had to be.
struct KeptOut {
  bool moved;
  vec3 place;
  vec3 normal;
};

#endif
