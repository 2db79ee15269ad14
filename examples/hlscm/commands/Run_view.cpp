// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "commands/Commands.h"
#include "commands/Repairs.h"
#include "commands/Viewed_input.h"
#include "common/Interruption.h"
#include "common/Program_error.h"
#include "common/Share_folder.h"
#include "reading/File_bytes.h"
#include "writing/Output_files.h"

#include <cstdlib>
#include <filesystem>
#include <iostream>

namespace hlscm {

namespace fs = std::filesystem;

namespace {

constexpr char page_name[] = "viewer.html";
constexpr char page_variable[] = "HLSCM_VIEW_PAGE";

// Where the options or the environment say, or beside the program, in its build or where it was
// installed
fs::path page_file(const Program_options& options)
{
  const char* named = std::getenv(page_variable);
  if(!options.view_page.empty()) {
    return options.view_page;
  }
  if(named != nullptr && *named != '\0') {
    return named;
  }
  return share_folder() / page_name;
}

std::string read_page(const fs::path& file)
{
  std::string page = load_page(file);
  if(page.find(view_page_mark) == std::string::npos) {
    throw Program_error(file.string(), "this is not the page that shows models, name another one");
  }
  return page;
}

} // namespace

int run_view(const Program_options& options)
{
  Progress_bar progress(!options.is_quiet);
  const fs::path empty_page = page_file(options);
  const std::string page = read_page(empty_page);
  Output_files files;
  refuse_to_overwrite(options.input, options.output);
  refuse_to_overwrite(empty_page, options.output);
  Output_file& file = files.create(options.output);
  Levels_report report;
  const Viewed_model model = read_viewed(options, progress, report);
  progress.start_stage("writing");
  file.put(fill_view_page(page, model));
  const std::size_t size = file.size();
  Interruption::finish();
  files.commit();
  progress.erase();
  if(!options.is_quiet) {
    print_notes(options.input, report.repairs, report.warnings);
    std::cout << "written     " << options.output << " (" << size << " bytes)\n" << std::flush;
  }
  return 0;
}

} // namespace hlscm
