// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef HLSCM_TEST_SUPPORT_REAL_MESHES_H
#define HLSCM_TEST_SUPPORT_REAL_MESHES_H

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <string>

namespace test_support {

// The folder that an environment variable names; an empty path if it names none.
inline std::filesystem::path folder_of_environment(const char* variable)
{
  const char* folder = std::getenv(variable);
  return folder != nullptr ? std::filesystem::path(folder) : std::filesystem::path();
}

// The path of one of the meshes of Debian's libcgal-demo, such as "mannequin-devil.off".
//
// Throws if scripts/test.sh, or whoever runs the test, has not set HLSCM_DATA_DIR to their folder.
inline std::string debian_mesh(const std::string& name)
{
  const std::filesystem::path file = folder_of_environment("HLSCM_DATA_DIR") / name;
  if(!std::filesystem::is_regular_file(file))
    throw std::runtime_error("no mesh " + name + ": set HLSCM_DATA_DIR to the folder that "
                             + "scripts/debian_meshes.sh prints");
  return file.string();
}

// Tests of these meshes, which are skipped where they are not.
template <class Base>
class With_debian_meshes : public Base
{
protected:
  void SetUp() override
  {
    if(folder_of_environment("HLSCM_DATA_DIR").empty())
      GTEST_SKIP() << "HLSCM_DATA_DIR names no folder";
  }
};

// The folder of further meshes, HLSCM_EXTRA_DATA_DIR; an empty path if there is none.
inline std::filesystem::path extra_meshes()
{
  return folder_of_environment("HLSCM_EXTRA_DATA_DIR");
}

} // namespace test_support

#endif
