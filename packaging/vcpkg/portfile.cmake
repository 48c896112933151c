# A port that no vcpkg has run. Its steps, by cmake alone, made a static package that find_package finds, for Debug and for Release.
# Whoever publishes fills in the address and the commit.
vcpkg_from_git(OUT_SOURCE_PATH SOURCE_PATH URL <address of this repository> REF <commit of v${VERSION}>)
vcpkg_cmake_configure(SOURCE_PATH "${SOURCE_PATH}")
vcpkg_cmake_install()
vcpkg_cmake_config_fixup(CONFIG_PATH lib/cmake/tribox)
vcpkg_fixup_pkgconfig()
file(REMOVE_RECURSE "${CURRENT_PACKAGES_DIR}/debug/include")
vcpkg_install_copyright(FILE_LIST "${SOURCE_PATH}/LICENSE")
