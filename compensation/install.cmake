# What a robot's controller PC gets, as a component of its own: cmake --install BUILD --component compensation.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
set(package ${CMAKE_CURRENT_BINARY_DIR}/truepose_compensationConfig.cmake)
set(folder ${CMAKE_INSTALL_LIBDIR}/cmake/truepose_compensation)
configure_package_config_file(truepose_compensationConfig.cmake.in ${package}
  INSTALL_DESTINATION ${folder} PATH_VARS CMAKE_INSTALL_LIBDIR CMAKE_INSTALL_INCLUDEDIR)
write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/truepose_compensationConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
file(RELATIVE_PATH TRUEPOSE_PREFIX_FROM_PC /prefix/${CMAKE_INSTALL_LIBDIR}/pkgconfig /prefix)
configure_file(truepose_compensation.pc.in truepose_compensation.pc @ONLY)

install(TARGETS truepose_compensation truepose_compensation_shared COMPONENT compensation
  LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT compensation
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT compensation)
install(FILES include/truepose/compensation.h include/truepose/compensation_c.h
  DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/truepose COMPONENT compensation)
install(FILES ${package} ${CMAKE_CURRENT_BINARY_DIR}/truepose_compensationConfigVersion.cmake
  DESTINATION ${folder} COMPONENT compensation)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/truepose_compensation.pc
  DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT compensation)
