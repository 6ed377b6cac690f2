/* Ringlet's C interface: the solver for programs that are not written in C++. The same core, the same bits.

   Functions that can fail return a ringlet_result; where it is not RINGLET_OK, ringlet_error_message() says,
   on the same thread, what was tried, what was found and what to do. No exception leaves a function, not one
   of a callback either, and none aborts for a wrong argument.

   Structs that are handed over begin with their size, so that later versions may add members: set it with
   RINGLET_INIT, which leaves the rest 0, and 0 is the default of every member. Structs of one array have one
   size.

   Handles may be used by one thread at a time; those of one device or asset by different threads at once. A
   device lives as long as anything made of it, an asset as long as any hair of it, whatever was released
   before. Releasing NULL is fine. After fork() they are of use in the process that made them only: in
   another each function that takes hair or a device is an error. Open a device there.

   Lengths are in metres, times in seconds, turns as quaternions x, y, z, w with the axes of the groom. */
#ifndef RINGLET_C_RINGLET_H
#define RINGLET_C_RINGLET_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef enum ringlet_result {
  RINGLET_OK = 0,
  RINGLET_ERROR = 1,                  /* wrong settings, a wrong groom, no usable device: see the message */
  RINGLET_ERROR_INVALID_ARGUMENT = 2, /* a null pointer, a wrong count or an unknown name */
  RINGLET_ERROR_OUT_OF_MEMORY = 3,    /* the host has no memory left */
  RINGLET_ERROR_OUT_OF_DEVICE_MEMORY = 4, /* the device has no memory left */
  RINGLET_ERROR_DEVICE_LOST = 5,          /* the driver reports the device as lost */
  RINGLET_ERROR_COMPILE = 6               /* the driver cannot compile a kernel */
} ringlet_result;

typedef struct ringlet_device ringlet_device;     /* a Vulkan device */
typedef struct ringlet_settings ringlet_settings; /* how hair is stepped */
typedef struct ringlet_material ringlet_material; /* the physical properties of hair */
typedef struct ringlet_asset ringlet_asset;       /* groom, material and kernels: what does not change */
typedef struct ringlet_hair ringlet_hair;         /* the state of one head with that hair */

/* A struct whose size is set and whose other members are 0: ringlet_groom groom =
 * RINGLET_INIT(ringlet_groom); */
#ifdef __cplusplus
#define RINGLET_INIT(type) (::ringlet_c_init<type>())
#else
#define RINGLET_INIT(type) ((type){.struct_size = sizeof(type)})
#endif

/* The library's version, for example "0.1.0". */
const char* ringlet_version(void);
/* The message of the last function that failed on the calling thread; "" if none has failed. The text is
   valid until the next function fails on that thread. */
const char* ringlet_error_message(void);

/* Devices. */

/* Opens a device. `choice` is a part of its name or its index. With NULL or "" the environment variable
   RINGLET_DEVICE chooses, and without it the best device is taken. */
ringlet_result ringlet_device_open(const char* choice, ringlet_device** device);

/* Device memory for one buffer, from a host's allocator. */
typedef struct ringlet_memory {
  void* memory; /* VkDeviceMemory */
  uint64_t offset;
  void* mapped; /* address of the piece for the host; required for memory types that can be mapped */
  void* own;    /* for the allocator's own use */
} ringlet_memory;

/* A host's Vulkan objects, with the types that <vulkan/vulkan.h> gives them. The host keeps instance and
   device until it has released everything that was made with them here. */
typedef struct ringlet_host_vulkan {
  size_t struct_size;
  void* get_instance_proc_addr; /* PFN_vkGetInstanceProcAddr */
  void* instance;               /* VkInstance */
  void* physical_device;        /* VkPhysicalDevice */
  void* device;                 /* VkDevice */
  void* queue;                  /* VkQueue */
  uint32_t queue_family;        /* the family of the queue; it supports compute */
  uint32_t api_version;         /* the one in the host's VkApplicationInfo; at least 1.1 */
  int subgroup_size_control;    /* 1 if the device was created with this feature and the next */
  int compute_full_subgroups;
  /* The host's allocator, used in place of vkAllocateMemory. Set both functions or neither. `allocate`
     returns a VkResult. Every thread that creates objects on the device calls them. */
  int (*allocate)(void* user, uint64_t bytes, uint64_t alignment, uint32_t memory_type,
                  ringlet_memory* memory);
  void (*free)(void* user, const ringlet_memory* memory);
  void* user;
} ringlet_host_vulkan;

/* Says with what the host should create its device; Ringlet also works on a device without. Call it before
   vkCreateDevice, with all members of `host` but device and queue. `extension_names` has room for `capacity`
   names, or is NULL. The names are valid as long as the program runs. */
typedef struct ringlet_host_needs {
  size_t struct_size;
  uint32_t queue_family; /* the family to create the queue from */
  int subgroup_size_control;
  int compute_full_subgroups;
  uint32_t extension_count;
} ringlet_host_needs;
ringlet_result ringlet_device_needs(const ringlet_host_vulkan* host, ringlet_host_needs* needs,
                                    const char** extension_names, uint32_t capacity);
/* Uses the host's device. The host submits nothing to the queue while a function of this interface runs. */
ringlet_result ringlet_device_adopt(const ringlet_host_vulkan* host, ringlet_device** device);

/* The device's name, as the driver states it. The text is valid as long as the device. */
const char* ringlet_device_name(const ringlet_device* device);
void ringlet_device_release(ringlet_device* device);

/* Settings and materials are set by the names that scene and material files have (`ringlet scene --keys`,
   `ringlet material --list`): "gravity", "steps_per_frame", "contacts.friction", "air.wind";
   "bend_stiffness", "variation.core_stiffness". An unknown name is an error, whose message says the nearest
   name. Ranges are checked when an asset is built of them or hair is given them. */

ringlet_result ringlet_settings_create(ringlet_settings** settings);
/* Sets a number, a whole number or a switch (0 or 1). */
ringlet_result ringlet_settings_set(ringlet_settings* settings, const char* name, double value);
ringlet_result ringlet_settings_set_vector(ringlet_settings* settings, const char* name, double x, double y,
                                           double z);
/* Sets what is one of several words: "integrator", "contacts.method", "contacts.taper". */
ringlet_result ringlet_settings_set_text(ringlet_settings* settings, const char* name, const char* value);
void ringlet_settings_release(ringlet_settings* settings);

/* `preset` is a name from `ringlet material --list`. NULL or "" gives the default material. */
ringlet_result ringlet_material_create(const char* preset, ringlet_material** material);
ringlet_result ringlet_material_set(ringlet_material* material, const char* name, double value);
void ringlet_material_release(ringlet_material* material);

/* Hair. */

typedef struct ringlet_groom {
  size_t struct_size;
  const float* points;          /* x, y, z of every particle, root to tip, strand after strand */
  const uint32_t* strand_sizes; /* number of particles of each strand, at least 2 */
  uint32_t strand_count;
  double metres_per_unit; /* unit of the points; 0 means 1 */
} ringlet_groom;

/* What acts on hair from outside, besides its head and the air. A feature is added when it is first used,
   which compiles kernels, or before by ringlet_asset_options or ringlet_hair_prepare. */
typedef enum ringlet_features {
  RINGLET_BODIES = 1, /* ringlet_hair_set_bodies */
  RINGLET_ROOTS = 2,  /* root poses of frames */
  RINGLET_FORCES = 4, /* ringlet_hair_set_forces */
  RINGLET_GOALS = 8,  /* ringlet_hair_set_goals */
  RINGLET_FIELDS = 16 /* ringlet_hair_set_fields */
} ringlet_features;

typedef struct ringlet_asset_options {
  size_t struct_size;
  int32_t heads; /* approximate number of heads with this hair; 0 means 1. With 2 or more, one dispatch steps
                    many heads of hair by itself */
  /* Called for each warning, with a sentence for the user, before build returns. May be NULL. */
  void (*warn)(const char* sentence, void* user);
  void* user;
  uint32_t features; /* ringlet_features that hair begins with; others are added when they are first used */
} ringlet_asset_options;

/* Prepares hair for any number of heads. `settings`, `material` and `options` may be NULL. The function
   copies what it needs of its arguments. Cost: that of HairAsset::build (solver/hair_asset.h). */
ringlet_result ringlet_asset_build(ringlet_device* device, const ringlet_groom* groom,
                                   const ringlet_settings* settings, const ringlet_material* material,
                                   const ringlet_asset_options* options, ringlet_asset** asset);
uint64_t ringlet_asset_particle_count(const ringlet_asset* asset);
uint32_t ringlet_asset_strand_count(const ringlet_asset* asset);
void ringlet_asset_release(ringlet_asset* asset);

typedef struct ringlet_pose {
  double position[3]; /* at most 1e9 m away along each axis */
  double rotation[4]; /* quaternion x, y, z, w, which is normalized; four zeros are the identity */
} ringlet_pose;

/* A number by its name. `value`: the first of it, or x, y and z of what is a vector; 0 or 1 of what is true
   or false. */
typedef struct ringlet_number {
  const char* name;
  double value[3];
} ringlet_number;

/* A solid body that hair stays out of. `shape` is the name of one of bodyForms (scene/body_forms.h): sphere,
   with a radius; capsule, with a radius about a line of this length along Y, its middle at the origin; plane,
   the half space below Y = 0; box, with half_extents; mesh, closed surfaces of `vertices` and `triangles`.
   Its numbers have the names of bodyNumbers: these sizes, thickness, which is the distance that hair keeps
   from the surface, and friction, the coefficient of Coulomb friction; those left out have their defaults. */
typedef struct ringlet_body {
  size_t struct_size;
  const char* shape;
  const ringlet_number* numbers;
  uint32_t number_count;
  ringlet_pose pose;     /* in the head's frame; the head carries the body unless frames have body poses */
  const float* vertices; /* x, y, z */
  uint32_t vertex_count;
  const uint32_t* triangles; /* three vertices each, counterclockwise seen from outside */
  uint32_t triangle_count;
  int32_t cells;   /* cells of the mesh's distance grid along its longest side; 0 means 64 */
  int32_t deforms; /* 1 for a mesh that bends: frames give its points; `vertices` are where it is at first */
  /* Of a mesh that bends: the box in which hair can meet it, in the frame of its pose, which has the grid;
     all 0 means all of the mesh and some room about it (makeBendingMesh in bodies/make_bending_mesh.h). */
  double grid_low[3], grid_high[3];
  /* 1 for cloth: a mesh that bends, open or closed, whose both sides hold hair off, by `thickness`, 0.5 mm at
     least. It has no grid. */
  int32_t both_sides;
  /* Called for each warning of a mesh, with a sentence for the user that names the body, before the function
     that was given it returns. May be NULL. */
  void (*warn)(const char* sentence, void* user);
  void* user;
} ringlet_body;

typedef struct ringlet_initial_state {
  size_t struct_size;
  ringlet_pose head;
  const ringlet_body* bodies; /* read until create returns */
  uint32_t body_count;
  int keeps_on_device; /* 1 if positions are not copied to the host after every frame */
} ringlet_initial_state;

/* Creates the hair of one head, at rest, on a head that stands still. `initial` may be NULL. */
ringlet_result ringlet_hair_create(ringlet_asset* asset, const ringlet_initial_state* initial,
                                   ringlet_hair** hair);
void ringlet_hair_release(ringlet_hair* hair);

/* A frame of one head. `step_poses` are the head's poses at the end of each step; `step_count` is the setting
   steps_per_frame. */
typedef struct ringlet_frame {
  size_t struct_size;
  ringlet_hair* hair;
  const ringlet_pose* step_poses;
  uint32_t step_count;
  const ringlet_pose* body_poses; /* in the world, [step][body]; NULL: the head carries the bodies */
  const ringlet_pose* root_poses; /* in the head's frame, [step][strand]; NULL: roots stay in place */
  /* Of each body that deforms, in their order: [sample][vertex][x, y, z] in the world [m], samples spread
     evenly over the frame, the last at its end (BodyPoints in scene/body.h); NULL: they keep their shape. */
  const double* const* body_points;
  uint32_t point_samples;
} ringlet_frame;

/* Points that kernels of the host's have left on the device, such as those of a mesh that it skins there:
   x, y, z as floats. The rules are those of DevicePoints in solver/device_points.h. */
typedef struct ringlet_device_points {
  size_t struct_size;
  void* buffer;    /* VkBuffer */
  uint64_t offset; /* of the first point [bytes] */
  uint32_t stride; /* from a point to the next [bytes]; 0 means 12 */
  uint32_t count;
} ringlet_device_points;
/* Copies the points of each of `buffer_count` buffers to xyz[buffer], as body_points of a frame takes them,
   and waits. */
ringlet_result ringlet_read_device_points(ringlet_device* device, const ringlet_device_points* buffers,
                                          uint32_t buffer_count, double* const* xyz);

/* Computes a frame of each hair in one submission and waits for it. Each hair may occur once. */
ringlet_result ringlet_step(const ringlet_frame* frames, uint32_t frame_count);
/* Computes a frame of one hair; the head's poses are interpolated from its present one to `head`. */
ringlet_result ringlet_step_to(ringlet_hair* hair, const ringlet_pose* head);

/* Records frames into a VkCommandBuffer of the host's. When the device has executed it, the host calls
   ringlet_frame_is_over for each hair. Until then what looks at the hair's state or changes it is an error;
   forces, goals and fields may be set, and act from the next frame that is recorded. The rules are those of
   recordFrames in solver/hair_frames.h. */
ringlet_result ringlet_record(const ringlet_frame* frames, uint32_t frame_count, void* command_buffer);
ringlet_result ringlet_frame_is_over(ringlet_hair* hair);

/* Copies x, y, z of every particle after the last frame, in the groom's order, relative to the head's origin,
   along world axes. `particle_count` is the asset's. */
ringlet_result ringlet_positions(const ringlet_hair* hair, float* xyz, uint64_t particle_count);
ringlet_result ringlet_velocities(const ringlet_hair* hair, float* xyz, uint64_t particle_count);

/* Positions in device memory: element i is x, y, z, 0 as floats, of the groom's particle `particles[i]`.
   The rules are those of DevicePositions in solver/simulation.h. */
typedef struct ringlet_device_positions {
  size_t struct_size;
  void* buffer; /* VkBuffer */
  uint64_t bytes;
  const uint32_t* particles; /* valid as long as the hair */
  uint64_t particle_count;
} ringlet_device_positions;
uint32_t ringlet_device_positions_count(const ringlet_hair* hair);
ringlet_result ringlet_get_device_positions(const ringlet_hair* hair, uint32_t index,
                                            ringlet_device_positions* positions);

/* Change settings and material between frames. A change of something fixed is an error that names it
   (Simulation::setSettings, setMaterial). */
ringlet_result ringlet_hair_set_settings(ringlet_hair* hair, const ringlet_settings* settings);
ringlet_result ringlet_hair_set_material(ringlet_hair* hair, const ringlet_material* material);

/* Adds features (bits of ringlet_features) now, as their first use would (Simulation::prepare). */
ringlet_result ringlet_hair_prepare(ringlet_hair* hair, uint32_t features);

/* Replaces all bodies, by any number. They stand where their poses in the head's frame say. */
ringlet_result ringlet_hair_set_bodies(ringlet_hair* hair, const ringlet_body* bodies, uint32_t body_count);

/* Sets external forces: an acceleration x, y, z for every particle in the groom's order [m/s^2], each number
   from -1e6 to 1e6, which acts until others are set (Simulation::setForces). */
ringlet_result ringlet_hair_set_forces(ringlet_hair* hair, const float* xyz, uint64_t particle_count);

/* Places that particles are pulled to (Simulation::setGoals), in the groom's order and axes, carried by the
   head. A strength of 1 holds a particle's own weight 1 cm away. */
typedef struct ringlet_goals {
  size_t struct_size;
  const float* places;    /* x, y, z of every particle, at the end of the next frame and from then on; each
                             number from -1e6 to 1e6 */
  const float* strengths; /* of every particle, 0 to 1e7 */
  uint64_t particle_count;
  double damping_ratio; /* of the motion about a place, critical at 1, at most 1000; 0 means 1 */
  int undamped;         /* 1 for a damping ratio of 0 */
  const float* from;    /* places at the beginning of the next frame; NULL: those set before */
} ringlet_goals;
/* Sets goals, which act until others are set. */
ringlet_result ringlet_hair_set_goals(ringlet_hair* hair, const ringlet_goals* goals);

/* What acts at places in the world: accelerations [m/s^2], or with drag velocities of air [m/s]. Its numbers
   have the names of forceFieldNumbers (scene/force_field.h): axis, about_axis, axial, radial, around, core,
   reach, drag, front, thickness and grid_share; those left out have their defaults. */
typedef struct ringlet_field {
  size_t struct_size;
  ringlet_pose pose; /* in the world; of a grid its first node */
  const ringlet_number* numbers;
  uint32_t number_count;
  const float* velocities; /* of a grid's nodes, x, y, z, x the fastest index; NULL: no grid */
  uint32_t nodes[3];       /* along x, y and z */
  double cell;             /* distance between nodes; 0 means 0.1 */
} ringlet_field;
/* Replaces all fields, until others are set (Simulation::setFields). `from`: as they are at the beginning of
   the next frame, as many; NULL: they do not change in it. */
ringlet_result ringlet_hair_set_fields(ringlet_hair* hair, const ringlet_field* fields,
                                       const ringlet_field* from, uint32_t field_count);

/* Of a strand of the groom, the particles from `keep` on are cut off. */
typedef struct ringlet_cut {
  uint32_t strand, keep;
} ringlet_cut;
/* Cuts strands, from the next frame on; what is cut off falls (Simulation::cut). */
ringlet_result ringlet_hair_cut(ringlet_hair* hair, const ringlet_cut* cuts, uint32_t cut_count);

typedef struct ringlet_report {
  size_t struct_size;
  double max_edge_stretch; /* largest ratio of an edge's length to that in the groom, since the beginning */
  uint64_t nonfinite;      /* particles whose position or velocity is not finite now */
  uint64_t contacts;       /* pairs of particles that push each other away */
  uint64_t device_bytes;   /* of the hair's buffers */
} ringlet_report;
ringlet_result ringlet_get_report(const ringlet_hair* hair, ringlet_report* report);

/* Writes the state that later frames depend on (Simulation::checkpoint). `size` is the room in `bytes` and
   becomes the number of bytes written. With `bytes` NULL it only becomes that number. */
ringlet_result ringlet_checkpoint(ringlet_hair* hair, void* bytes, size_t* size);
/* Goes on from a checkpoint of such hair: of the same groom, settings, material and options, on the same
   device. Damaged bytes and those of other hair are an error, and nothing changes. The checks are against
   mistakes and not against intent: trust a checkpoint as you trust a program. */
ringlet_result ringlet_restore(ringlet_hair* hair, const void* bytes, size_t size);

#ifdef __cplusplus
}
template <class T>
T ringlet_c_init() {
  T value{};
  value.struct_size = sizeof(T);
  return value;
}
#endif
#endif
