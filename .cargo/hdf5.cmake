# How the bundled HDF5 library is compiled, read by cmake as its toolchain where cargo is called within the repository.
# After a change here: cargo clean -p hdf5-metno-src

# As cargo's level 1, of which cmake would make 3: that takes twice as long, and reads and writes our arrays no faster.
set(CMAKE_C_FLAGS_RELEASE "-O1 -DNDEBUG" CACHE STRING "")
set(CMAKE_C_FLAGS_RELWITHDEBINFO "-O1 -g -DNDEBUG" CACHE STRING "")

# Most of its authors' warnings, with an option to inline more. They are not shown, but looking for them is a seventh of
# the compiling.
set(HDF5_ENABLE_ALL_WARNINGS OFF CACHE BOOL "")
