# LGIW_PORTABLE: static libraries in place of shared ones, so that lgiw-run can be carried to a machine that has none of them
# (pipelines/bench-gpu). For lgiw-run alone: GDAL brings its own, shared HDF5 into the other tools.
if(LGIW_PORTABLE)
  set(HDF5_USE_STATIC_LIBRARIES ON)
  set(OPENSSL_USE_STATIC_LIBS ON)
  add_link_options(-static-libstdc++ -static-libgcc -Wl,--gc-sections)
endif()

# What the packages' own CMake files leave out of static linking; after find_package().
function(lgiw_make_portable)
  if(LGIW_PORTABLE)
    target_link_libraries(hdf5::hdf5 INTERFACE libsz.a libaec.a libz.a ${CMAKE_DL_LIBS})
    get_target_property(shared yaml-cpp LOCATION)
    get_filename_component(folder ${shared} DIRECTORY)
    set_target_properties(yaml-cpp PROPERTIES IMPORTED_LOCATION_NONE ${folder}/libyaml-cpp.a IMPORTED_LOCATION ${folder}/libyaml-cpp.a)
  endif()
endfunction()
