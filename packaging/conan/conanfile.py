# A recipe that no Conan 2 has run, only its steps by stand-ins, static. Whoever publishes fills in the address and the hash.
from conan import ConanFile
from conan.tools.cmake import CMake, cmake_layout
from conan.tools.files import copy, get, rmdir


class Tribox(ConanFile):
    name = "tribox"
    version = "1.0.0"
    description = "Exact triangle-box overlap tests on many triangles at once"
    license = "MIT"
    topics = ("geometry", "mesh", "voxelization", "simd")
    package_type = "library"
    settings = "os", "arch", "compiler", "build_type"
    options = {"shared": [True, False]}
    default_options = {"shared": False}
    languages = ("C",)
    generators = "CMakeToolchain"

    def layout(self):
        cmake_layout(self, src_folder="src")

    def source(self):
        get(self, "<address of this repository>/tribox-1.0.0.tar.xz", sha256="<its line in SHA256SUMS>", strip_root=True)

    def build(self):
        cmake = CMake(self)
        cmake.configure()
        cmake.build()

    def package(self):
        copy(self, "LICENSE", self.source_folder, f"{self.package_folder}/licenses")
        CMake(self).install()
        rmdir(self, f"{self.package_folder}/lib/cmake")
        rmdir(self, f"{self.package_folder}/lib/pkgconfig")

    def package_info(self):
        self.cpp_info.libs = ["tribox"]
        self.cpp_info.set_property("cmake_file_name", "tribox")
        self.cpp_info.set_property("cmake_target_name", "tribox::tribox")
        self.cpp_info.set_property("pkg_config_name", "tribox")
        if self.settings.os == "Windows" and self.options.shared:
            self.cpp_info.defines = ["TRIBOX_SHARED"]
