/* Ringlet's C interface of files: grooms, materials, meshes and scenes in, grooms, materials and animations
   out. Part of ringlet::io; what c/ringlet.h says of results, messages, structs, handles, threads and units
   holds here.

   Paths are UTF-8 where the system's are. Files that are written appear whole under their names, or not at
   all. */
#ifndef RINGLET_C_RINGLET_IO_H
#define RINGLET_C_RINGLET_IO_H

#include "ringlet/c/ringlet.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct ringlet_loaded_groom ringlet_loaded_groom; /* a groom of a file */
typedef struct ringlet_mesh ringlet_mesh;                 /* a mesh of a file */
typedef struct ringlet_scene ringlet_scene;               /* a scene with all that it names */
typedef struct ringlet_animation ringlet_animation;       /* an animation that is written */
typedef struct ringlet_frames ringlet_frames;             /* an animation that is read */

/* Called for each warning, with a sentence for the user, before the function that was given it returns. */
typedef void (*ringlet_warn)(const char* sentence, void* user);

/* Grooms. */

/* Which of a strand's two ends in the file is its root. */
typedef enum ringlet_root_end {
  RINGLET_ROOT_FIRST = 0,
  RINGLET_ROOT_LAST = 1,
  RINGLET_ROOT_ON_HEAD = 2 /* the one on a ball on which most strands have an end */
} ringlet_root_end;

typedef struct ringlet_groom_reading {
  size_t struct_size;
  double metres_per_unit; /* the unit of the points; 0: the file's, where it states one, else 0.01 */
  int up_is_z;            /* 1 if Z is up in the host: a file that states another axis is turned */
  ringlet_warn warn;      /* what is odd about the file, or seems wrong with the groom; may be NULL */
  void* user;
  uint32_t points_per_strand; /* of a file that holds points and nothing else; 0: it is refused */
  ringlet_root_end root_end;  /* strands whose root is the last point are turned round */
} ringlet_groom_reading;

/* Reads .hair, .obj, .tfx, .ply, .data, .bin, .usda, .usdc, .usd, .usdz and .abc. `reading` may be NULL. Only
   USD, and an .abc that Ringlet wrote, state unit and up axis; of other files the points are as they are, and
   gravity is the host's to set. */
ringlet_result ringlet_groom_read(const char* path, const ringlet_groom_reading* reading,
                                  ringlet_loaded_groom** groom);
/* The groom, for ringlet_asset_build; it points into `from`, and is valid as long. */
ringlet_result ringlet_loaded_groom_get(const ringlet_loaded_groom* from, ringlet_groom* groom);
void ringlet_loaded_groom_release(ringlet_loaded_groom* groom);
/* Writes .hair, .obj, .ply, .abc, .usda or .usdc; reading it gives the same bits, and of the last three the
 * unit.
 */
ringlet_result ringlet_groom_write(const char* path, const ringlet_groom* groom);

/* Materials. */

/* A preset by its name, or a material file (.toml) by a path; its dials are worked in. */
ringlet_result ringlet_material_read(const char* preset_or_path, ringlet_warn warn, void* user,
                                     ringlet_material** material);
ringlet_result ringlet_material_write(const char* path, const ringlet_material* material);

/* Meshes, the surfaces of bodies: .obj. */

/* `metres_per_unit`: of the file, from 1e-6 to 1000. */
ringlet_result ringlet_mesh_read(const char* path, double metres_per_unit, ringlet_mesh** mesh);
/* Makes the body one of this mesh: shape, vertices and triangles, which point into `from`. The rest stays. */
ringlet_result ringlet_mesh_get(const ringlet_mesh* from, ringlet_body* body);
void ringlet_mesh_release(ringlet_mesh* mesh);

/* Scenes: what `ringlet simulate` runs (docs/scene-files.md). */

typedef struct ringlet_scene_reading {
  size_t struct_size;
  const char* const*
      changes; /* "key=value" with the key's table, as --set has it: "groom.up=Z"; may be NULL */
  uint32_t change_count;
  ringlet_warn warn; /* may be NULL */
  void* user;
  int is_confined; /* 1 for a file of a stranger's: it may name files in or below its own folder only */
} ringlet_scene_reading;

/* Reads a scene file and all that it names. `reading` may be NULL. */
ringlet_result ringlet_scene_read(const char* path, const ringlet_scene_reading* reading,
                                  ringlet_scene** scene);
/* The same from text; its paths are relative to `folder`, which may be NULL. */
ringlet_result ringlet_scene_parse(const char* text, const char* folder, const ringlet_scene_reading* reading,
                                   ringlet_scene** scene);
void ringlet_scene_release(ringlet_scene* scene);

typedef struct ringlet_scene_facts {
  size_t struct_size;
  double frames_per_second;
  int32_t frame_count;      /* of a run, unless it is told */
  int32_t pre_roll_frames;  /* before the first, in which hair comes to rest or to speed */
  uint32_t steps_per_frame; /* poses of the head a frame */
  uint32_t body_count;
  uint32_t strand_count;
  int moving_roots; /* 1 if strands have poses of their own */
  uint32_t bending_body_count;
} ringlet_scene_facts;
ringlet_result ringlet_scene_get(const ringlet_scene* scene, ringlet_scene_facts* facts);

/* Its parts, for hosts that step hair themselves: the groom, which points into the scene; copies of settings
   and material, to be released; where everything is at the end of each step of a frame, 0 the first, as
   ringlet_frame has it. `body_poses` and `root_poses` may be NULL. */
ringlet_result ringlet_scene_groom(const ringlet_scene* scene, ringlet_groom* groom);
ringlet_result ringlet_scene_settings(const ringlet_scene* scene, ringlet_settings** settings);
ringlet_result ringlet_scene_material(const ringlet_scene* scene, ringlet_material** material);
ringlet_result ringlet_scene_frame_poses(const ringlet_scene* scene, int32_t frame, ringlet_pose* step_poses,
                                         ringlet_pose* body_poses, ringlet_pose* root_poses);
/* The points of one of the scene's bodies that bend, with as many samples as steps, as ringlet_frame has
   them. `vertex_count` is set to those of its mesh; `xyz` may be NULL. */
ringlet_result ringlet_scene_frame_points(const ringlet_scene* scene, int32_t frame, uint32_t bending_body,
                                          double* xyz, uint32_t* vertex_count);

/* The scene's hair as its run begins: an asset, built for all that the scene has and what `options` says
   besides, and hair of it with the scene's bodies, after the pre-roll. `options` may be NULL. */
ringlet_result ringlet_scene_build(ringlet_device* device, const ringlet_scene* scene,
                                   const ringlet_asset_options* options, ringlet_asset** asset);
ringlet_result ringlet_scene_hair(const ringlet_scene* scene, ringlet_asset* asset, ringlet_hair** hair);
/* Steps that hair through a frame, 0 the first, as a run does: with what motion, bodies, keys, fields, holds
   and cuts are then. Each cut is made by its own frame. Hair of another scene, or with other bodies, is an
   error. */
ringlet_result ringlet_scene_step(const ringlet_scene* scene, ringlet_hair* hair, int32_t frame);

/* What becomes of what a run finds in its folder. RESUME goes on from a checkpoint; without one it begins
   anew where nothing is left. */
typedef enum ringlet_leftovers {
  RINGLET_LEFTOVERS_REFUSE = 0,
  RINGLET_LEFTOVERS_OVERWRITE = 1,
  RINGLET_LEFTOVERS_RESUME = 2,
  RINGLET_LEFTOVERS_RESUME_OR_OVERWRITE = 3
} ringlet_leftovers;

typedef struct ringlet_run_options {
  size_t struct_size;
  int32_t frame_count;            /* 0: the scene's */
  ringlet_device* const* devices; /* the strands are divided among them; NULL: what ringlet_device_open
                                     opens */
  uint32_t device_count;          /* 0 with NULL */
  const char* folder;             /* where files go; NULL: nothing is written */
  const char* const* files;       /* which: "hair.usda", "last.obj", "sheet.png" ...; NULL: what the scene
                                     says, as all else about them */
  uint32_t file_count;
  int32_t checkpoint_frames; /* from one to the next that a killed run can go on from; 0: none */
  ringlet_leftovers leftovers;
  int (*go_on)(int32_t frame, void* user); /* after each frame, 1 the first; 0 ends the run early, but well;
                                              may be NULL */
  ringlet_warn warn;                       /* may be NULL */
  void* user;
} ringlet_run_options;
typedef struct ringlet_run_result {
  size_t struct_size;
  int32_t frame_count;     /* done, with those of a run before */
  int32_t resumed_from;    /* that a run before had done */
  int interrupted;         /* 1 if it ended before its last frame */
  int can_resume;          /* 1 if there is a checkpoint to go on from; files are then not finished */
  char positions_hash[24]; /* of the last frame, as `ringlet simulate --json` tells it */
} ringlet_run_result;
/* The scene's whole run, as `ringlet simulate` does it. `options` may be NULL: the positions only. `xyz`: of
   the last frame, as ringlet_positions; may be NULL. `result` may be NULL. Frames that are finished before an
   error are kept. */
ringlet_result ringlet_scene_run(const ringlet_scene* scene, const ringlet_run_options* options,
                                 ringlet_run_result* result, float* xyz, uint64_t particle_count);

/* Animations. */

typedef struct ringlet_animation_options {
  size_t struct_size;
  double frames_per_second; /* 0 means 24 */
  double metres_per_unit;   /* of the file; 0: the groom's */
  int up_is_z;              /* 1 if the file says that Z is up */
  double width;             /* of strands [m]; 0 means 0.0005 */
  double tip_width;         /* at the tip, of USD and Alembic; 0: as width */
  uint32_t frame_count; /* the most that will come, for which USD and .abc files keep room; 0 means 1000 */
  int sixteen_bits;     /* 1 for the short form of .rgc */
} ringlet_animation_options;

/* Begins PATH.partial, of .usda, .usdc, .abc, .rgc or .pc2 by the ending of `path`. Of the groom only the
   strands' sizes and the unit count, and for ringlet_animation_add the number of particles. `options` may be
   NULL. */
ringlet_result ringlet_animation_create(const char* path, const ringlet_groom* groom,
                                        const ringlet_animation_options* options,
                                        ringlet_animation** animation);
/* Adds a frame: what ringlet_positions gives, and where the head is; NULL: at the world's origin. */
ringlet_result ringlet_animation_add(ringlet_animation* animation, const float* xyz, uint64_t particle_count,
                                     const ringlet_pose* head);
/* The same with hair's positions and its head's place after its last frame. */
ringlet_result ringlet_animation_add_hair(ringlet_animation* animation, const ringlet_hair* hair);
/* Closes the file, of one frame at least, and gives it its name. */
ringlet_result ringlet_animation_finish(ringlet_animation* animation);
/* Without finish the frames so far stay as PATH.partial. */
void ringlet_animation_release(ringlet_animation* animation);

typedef struct ringlet_frames_facts {
  size_t struct_size;
  double frames_per_second, metres_per_unit;
  int up_is_z;
  int is_finished; /* 0 of a .partial */
  uint32_t frame_count, strand_count;
  uint64_t particle_count;
} ringlet_frames_facts;
/* Opens a .usda, .usdc, .abc or .rgc that Ringlet wrote, of a .partial the frames that are whole; or another
   program's animation (docs/formats.md). */
ringlet_result ringlet_frames_open(const char* path, ringlet_warn warn, void* user, ringlet_frames** frames);
ringlet_result ringlet_frames_get(const ringlet_frames* frames, ringlet_frames_facts* facts);
/* The next frame's points in the world, in the file's unit. After the last: an error. */
ringlet_result ringlet_frames_next(ringlet_frames* frames, float* xyz, uint64_t particle_count);
void ringlet_frames_release(ringlet_frames* frames);

#ifdef __cplusplus
}
#endif
#endif
