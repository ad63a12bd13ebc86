# One source compiled once per instruction set and copy, each in a namespace of its own and chosen at run time: a file of
# a few lines is made for each in the build tree.

# What compilers are told, and lanes of numbers in a register.
set(kernel_lanes_baseline 2)
set(kernel_options_baseline)
set(kernel_lanes_avx2 4)
set(kernel_options_avx2 -mavx2)
set(kernel_lanes_avx512 8)
set(kernel_options_avx512 -mavx512f -mavx512dq -mprefer-vector-width=512)

# epicyclic_kernels(<target> <source> SETS <set>... [DEFINITIONS <name>...] [OPTIONS <option>...] [OPTIONS_<set>
# <option>...])
#
# Adds <source>, as "model/kernels/x.inc", to the target for each of the sets: baseline, avx2, avx512, and avx2_again and
# avx512_again for another copy of the same (core/instruction_set.hpp says why). It finds defined EPICYCLIC_KERNELS, the
# name of its namespace, EPICYCLIC_KERNELS_NAME, that of the set in quotes, EPICYCLIC_KERNELS_COPY, 0 or 1, and
# EPICYCLIC_LANES.
function(epicyclic_kernels target source)
  cmake_parse_arguments(PARSE_ARGV 2 arg "" "" "SETS;DEFINITIONS;OPTIONS;OPTIONS_avx2;OPTIONS_avx512")
  cmake_path(GET source STEM name)
  foreach(KERNELS IN LISTS arg_SETS)
    string(REGEX REPLACE "_again$" "" SET ${KERNELS})
    string(COMPARE NOTEQUAL ${KERNELS} ${SET} again)
    set(file ${CMAKE_CURRENT_BINARY_DIR}/kernels/${name}_${KERNELS}.cpp)
    string(
      CONCAT text #
             "#define EPICYCLIC_KERNELS ${KERNELS}\n"
             "#define EPICYCLIC_KERNELS_NAME \"${SET}\"\n"
             "#define EPICYCLIC_KERNELS_COPY ${again}\n"
             "#define EPICYCLIC_LANES ${kernel_lanes_${SET}}\n"
             "#include \"${source}\"\n")
    file(CONFIGURE OUTPUT ${file} CONTENT "${text}" @ONLY)
    target_sources(${target} PRIVATE ${file})
    set_source_files_properties(
      ${file} PROPERTIES COMPILE_OPTIONS "${arg_OPTIONS};${kernel_options_${SET}};${arg_OPTIONS_${SET}}"
                         COMPILE_DEFINITIONS "${arg_DEFINITIONS}" SKIP_PRECOMPILE_HEADERS ON)
  endforeach()
endfunction()
