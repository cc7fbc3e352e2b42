# How it is used: packaging/README.md
from spack_repo.builtin.build_systems.cmake import CMakePackage

from spack.package import *


class Clathra(CMakePackage):
    """Discrete element solver for sand bonded by methane hydrate: specimens of discs, bonds whose
    size and strength follow from the hydrate saturation, biaxial compression between servo walls.
    Results are equal to the bit for every number of threads and ranks."""

    license("BSD-3-Clause")

    # Nothing has been released: a checkout (spack develop) needs neither an address nor a digest.
    version("0.1.0")

    variant("mpi", default=True, description="Several ranks")

    depends_on("c", type="build")  # FindHDF5 compiles a C program
    depends_on("cxx", type="build")
    depends_on("cmake@3.22:", type="build")
    depends_on("pkgconfig", type="build")
    depends_on("boost@1.66:")
    depends_on("cli11@2:")
    depends_on("eigen@3.3:3")
    depends_on("fmt@9")
    depends_on("hdf5+mpi", when="+mpi")
    depends_on("hdf5~mpi", when="~mpi")
    depends_on("kokkos@3.7:4 +openmp +serial cxxstd=20")
    depends_on("libpng")
    depends_on("mpi", when="+mpi")
    depends_on("nlohmann-json@3:")
    depends_on("tomlplusplus")
    depends_on("xxhash@0.8:")

    conflicts("%gcc@:10", msg="C++20 as GCC 11 and later have it")

    def cmake_args(self):
        return [
            self.define_from_variant("CLATHRA_MPI", "mpi"),
            self.define("CLATHRA_KOKKOS", "installed"),
            self.define("CLATHRA_NATIVE", False),
            self.define("CLATHRA_PERF", False),
            self.define("CLATHRA_TESTS", False),
            # So that the sources do not choose an instruction set of their own.
            self.define("CMAKE_CXX_FLAGS", microarchitecture_flags(self.spec, "cxx")),
        ]

    @run_after("install")
    @on_package_attributes(run_tests=True)
    def selftest(self):
        Executable(self.prefix.bin.clathra)("selftest")
