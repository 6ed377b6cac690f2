/* A tool in C: a handful of curls on a head that shakes, beside a sphere. */
#include <math.h>
#include <ringlet/c/ringlet.h>
#include <stdio.h>
#include <stdlib.h>

enum { kStrands = 100, kParticles = 32 };

static void check(ringlet_result result) {
  if (result == RINGLET_OK) return;
  fprintf(stderr, "error %d: %s\n", (int)result, ringlet_error_message());
  exit(1);
}

static void warn(const char* sentence, void* user) {
  ++*(int*)user;
  printf("warning: %s\n", sentence);
}

int main(void) {
  static float points[kStrands * kParticles * 3];
  static uint32_t sizes[kStrands];
  float* p = points;
  for (int s = 0; s < kStrands; ++s) {
    sizes[s] = kParticles;
    for (int i = 0; i < kParticles; ++i) {
      *p++ = 0.01f * (float)(s % 10) + 0.005f * cosf(0.8f * (float)i);
      *p++ = -0.004f * (float)i;
      *p++ = 0.01f * (float)(s / 10) + 0.005f * sinf(0.8f * (float)i);
    }
  }

  ringlet_device* device = NULL;
  check(ringlet_device_open(NULL, &device));
  ringlet_settings* settings = NULL;
  check(ringlet_settings_create(&settings));
  check(ringlet_settings_set(settings, "contacts.on", 1));
  check(ringlet_settings_set(settings, "contacts.friction", 0.2));
  ringlet_material* material = NULL;
  check(ringlet_material_create("loose_curl", &material));

  int warnings = 0;
  ringlet_groom groom = RINGLET_INIT(ringlet_groom);
  groom.points = points, groom.strand_sizes = sizes, groom.strand_count = kStrands;
  ringlet_asset_options options = RINGLET_INIT(ringlet_asset_options);
  options.features = RINGLET_BODIES, options.warn = warn, options.user = &warnings;
  ringlet_asset* asset = NULL;
  check(ringlet_asset_build(device, &groom, settings, material, &options, &asset));

  ringlet_body sphere = RINGLET_INIT(ringlet_body);
  ringlet_number radius = {"radius", {0.03}};
  sphere.shape = "sphere", sphere.numbers = &radius, sphere.number_count = 1, sphere.pose.position[1] = -0.1;
  ringlet_initial_state initial = RINGLET_INIT(ringlet_initial_state);
  initial.bodies = &sphere, initial.body_count = 1;
  ringlet_hair* hair = NULL;
  check(ringlet_hair_create(asset, &initial, &hair));
  ringlet_asset_release(asset); /* the hair keeps what it needs */

  for (int frame = 1; frame <= 24; ++frame) {
    ringlet_pose head = {{0.1 * sin(0.6 * frame), 0, 0}, {0, 0, 0, 0}};
    check(ringlet_step_to(hair, &head));
  }
  check(ringlet_settings_set_vector(settings, "gravity", 0, 0, -9.81));
  check(ringlet_hair_set_settings(hair, settings));
  check(ringlet_material_set(material, "bend_stiffness", 20));
  check(ringlet_hair_set_material(hair, material));
  ringlet_pose poses[8] = {{{0}, {0}}};
  ringlet_frame frame = RINGLET_INIT(ringlet_frame);
  frame.hair = hair, frame.step_poses = poses, frame.step_count = 8;
  check(ringlet_step(&frame, 1));

  check(ringlet_positions(hair, points, (uint64_t)kStrands * kParticles));
  ringlet_report report = RINGLET_INIT(ringlet_report);
  check(ringlet_get_report(hair, &report));
  printf("ringlet %s on %s: the last tip is at y = %.3f m, %u particles are nowhere, %d warnings\n",
         ringlet_version(), ringlet_device_name(device), (double)points[kStrands * kParticles * 3 - 2],
         (unsigned)report.nonfinite, warnings);
  const int isWrong = report.nonfinite != 0 || ringlet_settings_set(settings, "gravty", 1) == RINGLET_OK;
  printf("%s\n", ringlet_error_message());

  ringlet_hair_release(hair);
  ringlet_material_release(material);
  ringlet_settings_release(settings);
  ringlet_device_release(device);
  return isWrong;
}
