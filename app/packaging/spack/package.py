# Copyright 2026 The epicyclic developers
# SPDX-License-Identifier: GPL-3.0-or-later
"""Recipe of a Spack repository: packages/epicyclic/package.py. It builds the sources that are in a folder.

    spack dev-build -d /path/to/epicyclic epicyclic@main
"""

from spack.package import *


class Epicyclic(CMakePackage):
    """Nonlinear dynamics of planetary gear trains: bifurcation diagrams, branches of periodic orbits, regime maps,
    Lyapunov exponents."""

    license("GPL-3.0-or-later")

    version("main")

    variant("mpi", default=True, description="Studies on several processes")
    variant("claims", default=True, description="Claims of publications")

    depends_on("cmake@3.25:", type="build")
    depends_on("pkgconfig", type=("build", "run"))
    depends_on("eigen@3.4:3")
    depends_on("sundials@6.4:6 +ARKODE+CVODE")
    depends_on("gsl@2.7:")
    depends_on("nlohmann-json@3.11:")
    depends_on("cli11@2.1:")
    depends_on("fmt@9:")
    depends_on("hdf5@1.10: ~mpi")
    depends_on("openssl")
    depends_on("zlib-api")
    depends_on("mpi@3:", when="+mpi")
    depends_on("pagmo2@2.18:", when="+claims")
    depends_on("gnuplot+cairo+pangocairo", type="run")

    conflicts("%gcc@:11", msg="C++20 needs GCC 12")

    def cmake_args(self):
        return [
            self.define("EPICYCLIC_TESTS", False),
            self.define("EPICYCLIC_BATCHES", True),
            self.define("CMAKE_COMPILE_WARNING_AS_ERROR", False),
            self.define_from_variant("EPICYCLIC_MPI", "mpi"),
            self.define_from_variant("EPICYCLIC_CLAIMS", "claims"),
        ]
