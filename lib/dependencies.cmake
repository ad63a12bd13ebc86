# The libraries that epicyclic links. Included by lib/CMakeLists.txt and by the installed epicyclicConfig.cmake, so that
# the package asks for just what the build used.
include(CMakeFindDependencyMacro)

find_dependency(Eigen3 3.4)
find_dependency(SUNDIALS 6.4 COMPONENTS arkode cvode)
find_dependency(GSL 2.7)
find_dependency(Threads)
if(EPICYCLIC_HAS_CLAIMS)
  find_dependency(pagmo 2.18)
endif()
find_dependency(nlohmann_json 3.11)
find_dependency(fmt 9)
find_dependency(OpenSSL)
find_dependency(ZLIB)

# Not FindHDF5: it wants a C compiler and may answer with an MPI flavour. Debian names the serial one hdf5-serial.
find_dependency(PkgConfig)
pkg_search_module(EPICYCLIC_HDF5 REQUIRED QUIET IMPORTED_TARGET GLOBAL hdf5-serial hdf5)
