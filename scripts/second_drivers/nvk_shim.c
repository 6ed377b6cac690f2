// Mesa's no-op nouveau device, and what it lacks for newer GPUs: the classes of their engines, which NVK chooses by, and
// the parameters it asks for. nvk.sh builds it with Mesa's sources; NOUVEAU_CHIPSET says which GPU it is.
#include "nouveau/drm-shim/nouveau_noop.c"

static const uint64_t kMemory = 16ull << 30;

// Of a chipset, and of those from it up to the next row's.
struct EngineClasses {
  uint32_t chipset;
  int32_t copy, threeD, compute;
};
static const struct EngineClasses kEngineClasses[] = {
    {0x160, 0xc5b5, 0xc597, 0xc5c0},  // Turing
    {0x172, 0xc7b5, 0xc797, 0xc7c0},  // Ampere, but not GA100
    {0x180, 0xc8b5, 0xcb97, 0xcbc0},  // Hopper
    {0x190, 0xc7b5, 0xc997, 0xc9c0},  // Ada
    {0x1b0, 0xcab5, 0xce97, 0xcec0},  // Blackwell, but not GB100
};

static int answerParameter(int fd, unsigned long request, void *argument) {
  struct drm_nouveau_getparam *asked = argument;
  switch (asked->param) {
    case NOUVEAU_GETPARAM_EXEC_PUSH_MAX: asked->value = 512; return 0;
    case NOUVEAU_GETPARAM_FB_SIZE:
    case NOUVEAU_GETPARAM_VRAM_BAR_SIZE: asked->value = kMemory; return 0;
    case NOUVEAU_GETPARAM_VRAM_USED: asked->value = 1 << 20; return 0;
    case NOUVEAU_GETPARAM_HAS_VMA_TILEMODE: asked->value = 1; return 0;
    default: return nouveau_ioctl_get_param(fd, request, argument);
  }
}

static void listClasses(struct nvif_ioctl_sclass_v0 *list) {
  const struct EngineClasses *found = kEngineClasses;
  for (size_t i = 0; i < ARRAY_SIZE(kEngineClasses); ++i)
    if (kEngineClasses[i].chipset <= device_info.chip_id) found = &kEngineClasses[i];
  const int32_t classes[] = {0xa140, 0x902d, found->copy, found->threeD, found->compute};  // first: to memory, 2D
  for (size_t i = 0; i < ARRAY_SIZE(classes); ++i)
    list->oclass[i] = (struct nvif_ioctl_sclass_oclass_v0){classes[i], -1, -1};
}

static int answerObject(int fd, unsigned long request, void *argument) {
  struct nvif_ioctl_v0 *asked = argument;
  if (asked->type == NVIF_IOCTL_V0_SCLASS) {
    listClasses((struct nvif_ioctl_sclass_v0 *)(asked + 1));
    return 0;
  }
  const int status = nouveau_ioctl_nvif(fd, request, argument);
  const struct nvif_ioctl_mthd_v0 *method = (const struct nvif_ioctl_mthd_v0 *)(asked + 1);
  if (asked->type == NVIF_IOCTL_V0_MTHD && method->method == NV_DEVICE_V0_INFO)
    ((struct nv_device_info_v0 *)method->data)->ram_user = kMemory;
  return status;
}

__attribute__((constructor)) static void answerMore(void) {
  driver_ioctls[DRM_NOUVEAU_GETPARAM] = answerParameter;
  driver_ioctls[DRM_NOUVEAU_NVIF] = answerObject;
}
