# ringlet_add_kernel(target stem variant [DEFINITION ...]): compiles shaders/kernels/<stem>.comp with the given
# definitions and embeds the SPIR-V as `ringlet_shaders/<stem>_<variant>.h`, holding the array k_<stem>_<variant>.
# glslang writes a depfile, so a touched include rebuilds what includes it, and nothing else.
find_program(GLSLANG_VALIDATOR NAMES glslangValidator glslang REQUIRED)
set(RINGLET_SHADER_DIR ${PROJECT_SOURCE_DIR}/shaders)

function(ringlet_add_kernel target stem variant)
  set(name ${stem}_${variant})
  set(directory ${PROJECT_BINARY_DIR}/shaders/ringlet_shaders)
  set(header ${directory}/${name}.h)
  list(JOIN ARGN " " definitions)
  list(TRANSFORM ARGN PREPEND -D)
  file(MAKE_DIRECTORY ${directory})
  add_custom_command(
    OUTPUT ${header}
    COMMAND ${GLSLANG_VALIDATOR} --quiet $<$<BOOL:${RINGLET_SHADER_DEBUG}>:-g> --target-env vulkan1.1 -I${RINGLET_SHADER_DIR} ${ARGN}
            --depfile ${header}.d --vn k_${name} -o ${header} ${RINGLET_SHADER_DIR}/kernels/${stem}.comp
    DEPENDS ${RINGLET_SHADER_DIR}/kernels/${stem}.comp
    DEPFILE ${header}.d
    COMMENT "shader ${name}"
    VERBATIM COMMAND_EXPAND_LISTS)
  target_sources(${target} PRIVATE ${header})
  set_property(TARGET ${target} APPEND PROPERTY RINGLET_KERNELS ${name})
  set_property(TARGET ${target} APPEND PROPERTY RINGLET_KERNEL_TEXTS "${stem} ${definitions}")
  target_include_directories(${target} PRIVATE ${PROJECT_BINARY_DIR}/shaders)
endfunction()
