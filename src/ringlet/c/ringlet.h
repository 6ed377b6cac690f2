/* Ringlet's C interface: the solver for programs that are not written in C++. The same core, the same bits.

   Functions that can fail return a ringlet_result; where it is not RINGLET_OK, ringlet_error_message() says,
   on the same thread, what was tried, what was found and what to do. No exception leaves a function, and none
   aborts for a wrong argument.

   Structs that are handed over begin with their size, so that later versions may add members: set it with
   RINGLET_INIT, which leaves the rest 0, and 0 is the default of every member. Structs of one array have one
   size.

   Handles may be used by one thread at a time; those of one device or asset by different threads at once. A
   device lives as long as anything made of it, an asset as long as any hair of it, whatever was released
   before. Releasing NULL is fine.

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
  RINGLET_ERROR = 1,                      /* settings, a groom, a device that cannot be: see the message */
  RINGLET_ERROR_INVALID_ARGUMENT = 2,     /* the caller's fault: a null pointer, a count, a name */
  RINGLET_ERROR_OUT_OF_MEMORY = 3,        /* of the host's */
  RINGLET_ERROR_OUT_OF_DEVICE_MEMORY = 4, /* of the device's */
  RINGLET_ERROR_DEVICE_LOST = 5,          /* the driver gave up on it */
  RINGLET_ERROR_COMPILE = 6               /* the driver does not make a kernel */
} ringlet_result;

typedef struct ringlet_device ringlet_device;     /* a Vulkan device */
typedef struct ringlet_settings ringlet_settings; /* how hair is stepped */
typedef struct ringlet_material ringlet_material; /* what hair is made of */
typedef struct ringlet_asset ringlet_asset;       /* all of some hair that does not change */
typedef struct ringlet_hair ringlet_hair;         /* the state of one head with that hair */

/* A struct with its size and nothing else set: ringlet_groom groom = RINGLET_INIT(ringlet_groom); */
#ifdef __cplusplus
#define RINGLET_INIT(type) (::ringlet_c_init<type>())
#else
#define RINGLET_INIT(type) ((type){.struct_size = sizeof(type)})
#endif

/* "0.1.0" */
const char* ringlet_version(void);
/* Of the last function that failed on this thread; "" before. Good until the next one does. */
const char* ringlet_error_message(void);

/* Devices. */

/* Opens the device `choice` names, by part of its name or by index; NULL or "" takes $RINGLET_DEVICE, else
   the best. */
ringlet_result ringlet_device_open(const char* choice, ringlet_device** device);

/* A host's Vulkan; handles as <vulkan/vulkan.h> has them. The host keeps instance and device until everything
   made of them here is released. */
/* Device memory for one buffer, from a host's allocator. */
typedef struct ringlet_memory {
  void* memory; /* VkDeviceMemory */
  uint64_t offset;
  void* mapped; /* where the host sees the piece; of memory types that can be mapped, which must be */
  void* own;    /* whatever the host knows it by */
} ringlet_memory;

typedef struct ringlet_host_vulkan {
  size_t struct_size;
  void* get_instance_proc_addr; /* PFN_vkGetInstanceProcAddr */
  void* instance;               /* VkInstance */
  void* physical_device;        /* VkPhysicalDevice */
  void* device;                 /* VkDevice */
  void* queue;                  /* VkQueue */
  uint32_t queue_family;        /* the queue's, which computes */
  uint32_t api_version;         /* of the host's VkApplicationInfo, 1.1 at least */
  int subgroup_size_control;    /* whether the device was opened with these features */
  int compute_full_subgroups;
  /* In place of vkAllocateMemory, both or neither; allocate returns a VkResult. Any thread that makes
     something on the device calls them. */
  int (*allocate)(void* user, uint64_t bytes, uint64_t alignment, uint32_t memory_type,
                  ringlet_memory* memory);
  void (*free)(void* user, const ringlet_memory* memory);
  void* user;
} ringlet_host_vulkan;

/* Before vkCreateDevice, of all but device and queue: what the device should be opened with. It works
   without. `extension_names`: room for that many names, each good as long as the program; may be NULL. */
typedef struct ringlet_host_needs {
  size_t struct_size;
  uint32_t queue_family; /* the best one */
  int subgroup_size_control;
  int compute_full_subgroups;
  uint32_t extension_count;
} ringlet_host_needs;
ringlet_result ringlet_device_needs(const ringlet_host_vulkan* host, ringlet_host_needs* needs,
                                    const char** extension_names, uint32_t capacity);
/* During calls the host hands nothing to the queue. */
ringlet_result ringlet_device_adopt(const ringlet_host_vulkan* host, ringlet_device** device);

/* As the driver states it; good as long as the device. */
const char* ringlet_device_name(const ringlet_device* device);
void ringlet_device_release(ringlet_device* device);

/* Settings and materials, by the names that scene and material files have (`ringlet scene --keys`,
   `ringlet material --list`): "gravity", "steps_per_frame", "contacts.friction", "air.wind";
   "bend_stiffness", "variation.core_stiffness". A name that there is not is refused, with the one it may have
   meant. Numbers are checked when they are used. */

ringlet_result ringlet_settings_create(ringlet_settings** settings);
/* A number, a whole number or a switch (0 or 1). */
ringlet_result ringlet_settings_set(ringlet_settings* settings, const char* name, double value);
ringlet_result ringlet_settings_set_vector(ringlet_settings* settings, const char* name, double x, double y,
                                           double z);
/* One of several words: "integrator", "contacts.method", "contacts.taper". */
ringlet_result ringlet_settings_set_text(ringlet_settings* settings, const char* name, const char* value);
void ringlet_settings_release(ringlet_settings* settings);

/* `preset`: one of `ringlet material --list`; NULL or "": the default. */
ringlet_result ringlet_material_create(const char* preset, ringlet_material** material);
ringlet_result ringlet_material_set(ringlet_material* material, const char* name, double value);
void ringlet_material_release(ringlet_material* material);

/* Hair. */

typedef struct ringlet_groom {
  size_t struct_size;
  const float* points;          /* x, y, z of every particle, root to tip, strand after strand */
  const uint32_t* strand_sizes; /* particles of each strand, 2 at least */
  uint32_t strand_count;
  double metres_per_unit; /* of the points; 0: 1 */
} ringlet_groom;

typedef struct ringlet_asset_options {
  size_t struct_size;
  int has_bodies;   /* hair will stay out of some */
  int moving_roots; /* strands will have poses of their own */
  int32_t heads;    /* with this hair, about; 0: 1 */
  /* Told a sentence for the user of everything the asset warns of, before build returns; or NULL. */
  void (*warn)(const char* sentence, void* user);
  void* user;
  int has_forces; /* from outside, ringlet_hair_set_forces */
} ringlet_asset_options;

/* settings, material and options may be NULL. Nothing of what is handed over is needed afterwards. Cost: as
   HairAsset::build (solver/hair_asset.h). */
ringlet_result ringlet_asset_build(ringlet_device* device, const ringlet_groom* groom,
                                   const ringlet_settings* settings, const ringlet_material* material,
                                   const ringlet_asset_options* options, ringlet_asset** asset);
uint64_t ringlet_asset_particle_count(const ringlet_asset* asset);
uint32_t ringlet_asset_strand_count(const ringlet_asset* asset);
void ringlet_asset_release(ringlet_asset* asset);

typedef struct ringlet_pose {
  double position[3];
  double rotation[4]; /* x, y, z, w, of any length but 0; all 0 is no turn */
} ringlet_pose;

typedef enum ringlet_shape {
  RINGLET_SPHERE = 0,  /* radius */
  RINGLET_CAPSULE = 1, /* radius about a line of `length` along Y, its middle at the origin */
  RINGLET_PLANE = 2,   /* the half space below Y = 0 */
  RINGLET_BOX = 3,     /* half_extents */
  RINGLET_MESH = 4     /* vertices, triangles; closed surfaces */
} ringlet_shape;

/* What hair stays out of; solid. */
typedef struct ringlet_body {
  size_t struct_size;
  ringlet_shape shape;
  double radius, length, half_extents[3];
  double thickness;      /* hair keeps this much further away */
  double friction;       /* Coulomb's coefficient; 0.2 is usual */
  ringlet_pose pose;     /* in the head's frame, with which it goes unless frames say otherwise */
  const float* vertices; /* x, y, z */
  uint32_t vertex_count;
  const uint32_t* triangles; /* three vertices each, counterclockwise seen from outside */
  uint32_t triangle_count;
  int32_t cells; /* of the mesh's distance grid, along its longest side; 0: 64 */
} ringlet_body;

typedef struct ringlet_initial_state {
  size_t struct_size;
  ringlet_pose head;
  const ringlet_body* bodies; /* needed until create returns */
  uint32_t body_count;
  int keeps_on_device; /* positions are not brought to the host after every frame */
} ringlet_initial_state;

/* `initial` may be NULL. The hair is at rest, on a head that stands still. */
ringlet_result ringlet_hair_create(ringlet_asset* asset, const ringlet_initial_state* initial,
                                   ringlet_hair** hair);
void ringlet_hair_release(ringlet_hair* hair);

/* A frame: the head's pose at the end of each of its steps, as many as the settings' steps_per_frame. */
typedef struct ringlet_frame {
  size_t struct_size;
  ringlet_hair* hair;
  const ringlet_pose* step_poses;
  uint32_t step_count;
  const ringlet_pose* body_poses; /* in the world, [step][body]; NULL: bodies go with the head */
  const ringlet_pose* root_poses; /* of strands in the head's frame, [step][strand]; NULL: they stay */
} ringlet_frame;

/* All in one submission, and waits for it. Each hair once. */
ringlet_result ringlet_step(const ringlet_frame* frames, uint32_t frame_count);
/* One hair, the head's poses interpolated from where it is. */
ringlet_result ringlet_step_to(ringlet_hair* hair, const ringlet_pose* head);

/* Into a VkCommandBuffer of the host's; ringlet_frame_is_over of each hair when the device is done with it.
   Rules: recordFrames in solver/hair_frames.h. */
ringlet_result ringlet_record(const ringlet_frame* frames, uint32_t frame_count, void* command_buffer);
ringlet_result ringlet_frame_is_over(ringlet_hair* hair);

/* x, y, z of every particle in the groom's order, relative to the head's origin, along world axes.
   `particle_count`: the asset's. Of the last frame. */
ringlet_result ringlet_positions(const ringlet_hair* hair, float* xyz, uint64_t particle_count);
ringlet_result ringlet_velocities(const ringlet_hair* hair, float* xyz, uint64_t particle_count);

/* Positions in the device's memory: x y z 0 as floats, of the groom's particle `particles[i]` at place i.
   Rules: DevicePositions in solver/simulation.h. */
typedef struct ringlet_device_positions {
  size_t struct_size;
  void* buffer; /* VkBuffer */
  uint64_t bytes;
  const uint32_t* particles; /* good as long as the hair */
  uint64_t particle_count;
} ringlet_device_positions;
uint32_t ringlet_device_positions_count(const ringlet_hair* hair);
ringlet_result ringlet_get_device_positions(const ringlet_hair* hair, uint32_t index,
                                            ringlet_device_positions* positions);

/* Between frames; what may not change is refused by name (Simulation::setSettings, setMaterial). */
ringlet_result ringlet_hair_set_settings(ringlet_hair* hair, const ringlet_settings* settings);
ringlet_result ringlet_hair_set_material(ringlet_hair* hair, const ringlet_material* material);

/* Other bodies in place of those there are, any number, where their poses in the head's frame say. */
ringlet_result ringlet_hair_set_bodies(ringlet_hair* hair, const ringlet_body* bodies, uint32_t body_count);

/* Forces from outside: on each kilogram of every particle, x y z, groom order [m/s^2], until others are set
   (Simulation::setForces). Of an asset whose options say has_forces. */
ringlet_result ringlet_hair_set_forces(ringlet_hair* hair, const float* xyz, uint64_t particle_count);

typedef struct ringlet_report {
  size_t struct_size;
  double max_edge_stretch; /* longest edge over the groom's edge, since the beginning */
  uint64_t nonfinite;      /* particles that have no finite place or velocity now */
  uint64_t contacts;       /* pairs of particles whose springs push */
  uint64_t device_bytes;   /* of the hair's buffers */
} ringlet_report;
ringlet_result ringlet_get_report(const ringlet_hair* hair, ringlet_report* report);

/* All that later frames depend on (Simulation::checkpoint). With `bytes` NULL it says how many there are;
   `size`: in, room; out, how many. */
ringlet_result ringlet_checkpoint(ringlet_hair* hair, void* bytes, size_t* size);
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
