# ringlet_install_only_if_built(WHAT FILE TARGET [COMPONENT]): where FILE was not built, the install rules of this folder
# that follow are left out, and one line says so. A tree is often built by one target, and installed from that.
function(ringlet_install_only_if_built what file target)
  set(component)
  if(ARGC GREATER 3)
    set(component COMPONENT ${ARGV3})
  endif()
  install(CODE "if(NOT EXISTS \"${file}\")
    message(STATUS \"Not installed: ${what}, which is not built (cmake --build FOLDER --target ${target})\")
    return()
  endif()" ${component})
endfunction()

# Without the core of the library nothing is of use: then nothing is installed.
function(ringlet_install_only_with_core)
  install(CODE "if(NOT EXISTS \"$<TARGET_FILE:ringlet_core>\")
    message(FATAL_ERROR \"There is nothing to install: ringlet::core is not built (cmake --build FOLDER)\")
  endif()")
endfunction()
