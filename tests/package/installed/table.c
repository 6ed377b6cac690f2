/* The lines of C in the table of docs/library.md, in its order. Reads hair.usdc, curls.toml, scene.toml and
   head.obj; writes hair.ply and hair.rgc. */
#include <ringlet/c/ringlet_io.h>
#include <stdio.h>
#include <stdlib.h>

static void check(ringlet_result result) {
  if (result != RINGLET_OK) puts(ringlet_error_message()), exit(1);
}
static void warn(const char* sentence, void* user) { fprintf(user, "%s\n", sentence); }

int main(void) {
  void* user = stdout;
  ringlet_loaded_groom* file;
  ringlet_groom groom = RINGLET_INIT(ringlet_groom);
  ringlet_groom_reading wanted = RINGLET_INIT(ringlet_groom_reading);
  ringlet_material* material;
  ringlet_scene* scene;
  ringlet_scene_facts facts = RINGLET_INIT(ringlet_scene_facts);
  ringlet_scene_reading reading = RINGLET_INIT(ringlet_scene_reading);
  ringlet_run_options run = RINGLET_INIT(ringlet_run_options);
  ringlet_run_result result = RINGLET_INIT(ringlet_run_result);
  const char* changes[] = {"material.preset=coil"};
  ringlet_device* device;
  ringlet_asset* asset;
  ringlet_hair* hair;
  ringlet_mesh* mesh;
  ringlet_body body = RINGLET_INIT(ringlet_body);
  ringlet_pose heads[340];
  ringlet_animation* film;
  ringlet_animation_options options = RINGLET_INIT(ringlet_animation_options);
  ringlet_frames* frames;
  float* xyz;
  uint64_t count = 0;

  wanted.warn = warn;
  wanted.user = user;
  check(ringlet_groom_read("hair.usdc", &wanted, &file));
  check(ringlet_loaded_groom_get(file, &groom));
  check(ringlet_groom_write("hair.ply", &groom));

  check(ringlet_material_read("curls.toml", warn, user, &material));

  check(ringlet_device_open(NULL, &device));
  check(ringlet_scene_read("scene.toml", NULL, &scene));
  check(ringlet_scene_get(scene, &facts));
  check(ringlet_scene_build(device, scene, NULL, &asset));
  check(ringlet_scene_hair(scene, asset, &hair));
  for (int f = 0; f < facts.frame_count; ++f) check(ringlet_scene_step(scene, hair, f));
  run.folder = "out_of_c", run.checkpoint_frames = 10;
  check(ringlet_scene_run(scene, &run, &result, NULL, 0));
  reading.changes = changes, reading.change_count = 1;
  reading.is_confined = 1;
  check(ringlet_scene_read("scene.toml", &reading, &scene));

  check(ringlet_mesh_read("head.obj", 0.01, &mesh));
  check(ringlet_mesh_get(mesh, &body));
  check(ringlet_hair_set_bodies(hair, &body, 1));

  check(ringlet_scene_frame_poses(scene, 0, heads, NULL, NULL));

  check(ringlet_scene_groom(scene, &groom));
  options.frames_per_second = 30, options.frame_count = 48;
  check(ringlet_animation_create("hair.rgc", &groom, &options, &film));
  check(ringlet_animation_add_hair(film, hair));
  check(ringlet_animation_finish(film));

  check(ringlet_frames_open("hair.rgc", warn, user, &frames));
  for (uint32_t s = 0; s < groom.strand_count; ++s) count += groom.strand_sizes[s];
  xyz = malloc(3 * count * sizeof *xyz);
  check(ringlet_frames_next(frames, xyz, count));
  free(xyz);
  return 0; /* the system takes back what _release functions would give */
}
