# Debian packages by cpack, one for each component of install.cmake and of lib/CMakeLists.txt; app/packages calls it.
#
# The same commit gives the same bytes: version and date are the commit's (SOURCE_DATE_EPOCH, which app/packages sets).
include(GNUInstallDirs)
set(packages
    program=epicyclic
    development=libepicyclic-dev
    python=python3-epicyclic
    mpi=epicyclic-mpi)

set(seconds $ENV{SOURCE_DATE_EPOCH})
if(NOT seconds)
  message(FATAL_ERROR "EPICYCLIC_PACKAGES needs SOURCE_DATE_EPOCH: app/packages sets it")
endif()
set(version ${PROJECT_VERSION})
set(maintainer "$ENV{EPICYCLIC_MAINTAINER}")
string(TIMESTAMP stamp "%Y%m%d%H%M%S" UTC) # of SOURCE_DATE_EPOCH
string(TIMESTAMP date "%a, %d %b %Y %H:%M:%S +0000" UTC)
if(NOT "$ENV{EPICYCLIC_COMMIT}" STREQUAL "")
  string(APPEND version "+git${stamp}.$ENV{EPICYCLIC_COMMIT}")
endif()

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME epicyclic)
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "") # each component has its own
set(CPACK_PACKAGE_VENDOR "The epicyclic developers")
set(CPACK_PACKAGE_VERSION ${version})
set(CPACK_PACKAGE_CONTACT "${maintainer}")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE
                                                WORLD_READ WORLD_EXECUTE)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_COMPONENTS_ALL)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)

set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS "gnuplot-nox | gnuplot, fonts-dejavu-core")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS "bash-completion, epicyclic-mpi, python3-epicyclic")
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION
    "nonlinear dynamics of planetary gear trains
Bifurcation diagrams, branches of periodic orbits, regime maps and Lyapunov
exponents of planetary gear stages with backlash, bearing clearance and
time-varying mesh stiffness. Each result has an error bound or a check.
.
This package has the program, its inputs, the schema for editors and the
functions for Octave.")

set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
# What find_package(epicyclic) searches: lib/dependencies.cmake.
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
    "libsundials-dev, libeigen3-dev, libgsl-dev, nlohmann-json3-dev, libfmt-dev, libhdf5-dev, libssl-dev, zlib1g-dev, \
libpagmo-dev, pkg-config")
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION
    "nonlinear dynamics of planetary gear trains (C++20 library)
Static libraries, headers and the CMake package epicyclic: models of planetary
gear stages, and sections, regimes, periodic orbits, branches and exponents of
any system.")

# The module is of one version of Python.
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS ON)
math(EXPR next_minor "${Python_VERSION_MINOR} + 1")
set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
    "python3 (>= ${Python_VERSION_MAJOR}.${Python_VERSION_MINOR}), python3 (<< ${Python_VERSION_MAJOR}.${next_minor}), \
python3-numpy")
set(CPACK_DEBIAN_PYTHON_PACKAGE_RECOMMENDS
    "python3-h5py, python3-pandas, python3-xarray, python3-h5netcdf, python3-matplotlib")
set(CPACK_COMPONENT_PYTHON_DESCRIPTION
    "nonlinear dynamics of planetary gear trains (Python package)
Computes studies of planetary gear stages and of one's own oscillators, and
reads the results of epicyclic: tables with units, Poincare points, figures,
pandas and xarray.")
set(folder ${CMAKE_CURRENT_LIST_DIR}/python)
set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA "${folder}/postinst;${folder}/prerm") # compiled modules

set(CPACK_DEBIAN_MPI_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_MPI_PACKAGE_DEPENDS "epicyclic (= ${version})")
set(CPACK_DEBIAN_MPI_PACKAGE_RECOMMENDS "openmpi-bin")
set(CPACK_COMPONENT_MPI_DESCRIPTION
    "nonlinear dynamics of planetary gear trains (program with MPI)
The program epicyclic-mpi: epicyclic whose studies several processes and hosts
share by MPI.")

# Licence and changes, which each package has.
set(doc ${PROJECT_BINARY_DIR}/doc)
foreach(pair IN LISTS packages)
  string(REPLACE "=" ";" pair ${pair})
  list(GET pair 0 component)
  list(GET pair 1 package)
  list(APPEND CPACK_COMPONENTS_ALL ${component})
  string(TOUPPER ${component} upper)
  set(CPACK_DEBIAN_${upper}_PACKAGE_NAME ${package})
  file(MAKE_DIRECTORY ${doc}/${package})
  file(WRITE ${doc}/${package}/changelog
       "${package} (${version}) unstable; urgency=medium\n\n  * ${PROJECT_VERSION}: see CHANGELOG.md of the sources.\n\n"
       " -- ${maintainer}  ${date}\n")
  execute_process(COMMAND gzip -9nf ${doc}/${package}/changelog COMMAND_ERROR_IS_FATAL ANY)
  install(FILES ${doc}/${package}/changelog.gz ${CMAKE_CURRENT_LIST_DIR}/copyright
          DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${package} COMPONENT ${component})
endforeach()
include(CPack)
