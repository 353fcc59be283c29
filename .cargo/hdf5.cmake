# How the bundled HDF5 library is compiled, read by cmake as its toolchain where cargo is called within the repository.
# After a change here: cargo clean -p hdf5-metno-src

# As cargo's level 1, of which cmake would make 3: that takes twice as long, and reads and writes our arrays no faster.
# No tables to unwind it, a fifteenth of its size: no panic goes through it.
set(CMAKE_C_FLAGS_RELEASE "-O1 -fno-asynchronous-unwind-tables -DNDEBUG" CACHE STRING "")
set(CMAKE_C_FLAGS_RELWITHDEBINFO "-O1 -g -DNDEBUG" CACHE STRING "")

# Most of its authors' warnings, with an option to inline more. They are not shown, but looking for them is a seventh of
# the compiling.
set(HDF5_ENABLE_ALL_WARNINGS OFF CACHE BOOL "")

# The headers of the system, which nearly every file includes, are read once: a sixth of the compiling.
function(uplift_precompile_headers)
  if(TARGET hdf5-static)
    target_precompile_headers(
      hdf5-static PRIVATE <arpa/inet.h> <complex.h> <ctype.h> <dirent.h> <dlfcn.h> <errno.h> <fcntl.h> <fenv.h>
      <float.h> <inttypes.h> <limits.h> <math.h> <netdb.h> <netinet/in.h> <pthread.h> <pwd.h> <setjmp.h> <signal.h>
      <stdarg.h> <stdbool.h> <stddef.h> <stdint.h> <stdio.h> <stdlib.h> <string.h> <sys/file.h> <sys/ioctl.h>
      <sys/resource.h> <sys/socket.h> <sys/stat.h> <sys/time.h> <sys/types.h> <sys/wait.h> <time.h> <unistd.h>)
  endif()
endfunction()
if(UNIX AND NOT UPLIFT_PRECOMPILES)
  set(UPLIFT_PRECOMPILES ON)
  cmake_language(DEFER CALL uplift_precompile_headers)
endif()
