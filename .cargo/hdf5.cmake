# How the bundled HDF5 library is compiled, read by cmake as its toolchain.

# As cargo's level 1, of which cmake would make 3: that takes twice as long, and reads and writes our arrays no faster.
set(CMAKE_C_FLAGS_RELEASE "-O1 -DNDEBUG" CACHE STRING "")

# The warnings of its authors are not shown, but looking for them is a seventh of the compiling.
set(HDF5_ENABLE_ALL_WARNINGS OFF CACHE BOOL "")
