"""The recipe of Conan 2: `conan create lib/packaging/conan` packages the sources that this file stands in."""

import os

from conan import ConanFile
from conan.tools.cmake import CMake, CMakeDeps, CMakeToolchain, cmake_layout
from conan.tools.files import copy


class Supernormal(ConanFile):
    name = "supernormal"
    version = "0.1.0"
    license = "BSD-3-Clause"
    description = "Smooth convex bodies for the Open Dynamics Engine"
    settings = "os", "arch", "compiler", "build_type"
    options = {"shared": [True, False], "with_ode": [True, False]}
    default_options = {"shared": True, "with_ode": True}
    package_type = "library"

    def export_sources(self):
        root = os.path.join(self.recipe_folder, "..", "..", "..")
        for pattern in ("CMakeLists.txt", "LICENSE", "lib/*", "include/*"):
            copy(self, pattern, root, self.export_sources_folder)

    def requirements(self):
        self.requires("eigen/[>=3.4]", transitive_headers=True)
        if self.options.with_ode:
            self.requires("ode/[>=0.16]", transitive_headers=True, transitive_libs=True)

    def layout(self):
        cmake_layout(self)

    def generate(self):
        toolchain = CMakeToolchain(self)
        toolchain.cache_variables["SUPERNORMAL_BUILD_ODE_LAYER"] = bool(self.options.with_ode)
        toolchain.cache_variables["SUPERNORMAL_BUILD_PYTHON"] = False
        toolchain.generate()
        CMakeDeps(self).generate()

    def build(self):
        cmake = CMake(self)
        cmake.configure()
        cmake.build()

    def package(self):
        CMake(self).install()

    def package_info(self):
        core = self.cpp_info.components["core"]
        core.libs = ["supernormal-core"]
        core.requires = ["eigen::eigen"]
        core.set_property("cmake_target_name", "supernormal::core")
        core.set_property("pkg_config_name", "supernormal-core")
        if self.settings.os == "Windows" and not self.options.shared:
            core.defines = ["SUPERNORMAL_STATIC"]
        if self.options.with_ode:
            layer = self.cpp_info.components["supernormal"]
            layer.libs = ["supernormal"]
            layer.requires = ["core", "ode::ode"]
            layer.set_property("cmake_target_name", "supernormal::supernormal")
