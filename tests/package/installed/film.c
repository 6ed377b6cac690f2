/* From a groom to an animation: film GROOM ANIMATION */
#include <math.h>
#include <ringlet/c/ringlet_io.h>
#include <stdio.h>
#include <stdlib.h>

static void check(ringlet_result result) {
  if (result != RINGLET_OK) puts(ringlet_error_message()), exit(1);
}

int main(int argc, char** argv) {
  ringlet_loaded_groom* file;
  ringlet_device* device;
  ringlet_asset* asset;
  ringlet_hair* hair;
  ringlet_animation* film;
  ringlet_groom groom = RINGLET_INIT(ringlet_groom);
  ringlet_animation_options options = RINGLET_INIT(ringlet_animation_options);
  if (argc != 3) return puts("film GROOM ANIMATION"), 1;
  check(ringlet_groom_read(argv[1], NULL, &file));
  check(ringlet_loaded_groom_get(file, &groom));
  check(ringlet_device_open(NULL, &device));
  check(ringlet_asset_build(device, &groom, NULL, NULL, NULL, &asset));
  check(ringlet_hair_create(asset, NULL, &hair));
  options.frame_count = 24;
  check(ringlet_animation_create(argv[2], &groom, &options, &film));
  for (int frame = 1; frame <= 24; ++frame) {
    const ringlet_pose head = {{0.05 * sin(0.5 * frame), 0, 0}, {0, 0, 0, 1}};
    check(ringlet_step_to(hair, &head));
    check(ringlet_animation_add_hair(film, hair));
  }
  check(ringlet_animation_finish(film));
  return 0; /* the system takes back what _release functions would give */
}
