// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "commands/Commands.h"
#include "commands/Levels_report.h"
#include "commands/Progressive_building.h"
#include "commands/Repairs.h"
#include "common/Interruption.h"
#include "common/Program_error.h"
#include "common/Share_folder.h"
#include "reading/File_bytes.h"
#include "writing/Checkerboard.h"
#include "writing/Folder_outputs.h"

#include <CGAL/Surface_mesh_multiresolution/Progressive_mesh_file.h>

#include <filesystem>
#include <iostream>
#include <string>

namespace hlscm {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t web_checker_size = 1024, web_checker_squares = 64; // each way

std::string load_texture(const Program_options& options)
{
  if(options.web_texture.empty()) {
    return checkerboard_png(web_checker_size, web_checker_size, web_checker_squares);
  }
  std::string image = load_text(options.web_texture);
  if(image.compare(0, 4, "\x89PNG") != 0) {
    throw Program_error(options.web_texture, "this is not a PNG file, convert it");
  }
  return image;
}

} // namespace

int run_web(const Program_options& options)
{
  Progress_bar progress(!options.is_quiet);
  const std::string page = load_page(share_folder() / "stream.html");
  const std::string reader = load_page(share_folder() / "stream.wasm");
  const std::string texture = load_texture(options);
  Folder_outputs folder(options.output, {options.input, options.web_texture});
  Levels_report report;
  const Progressive_model model = make_progressive(options, progress, report);
  if(!options.web_texture.empty() && !model.has_texture()) {
    throw Program_error(options.input, "it has no texture coordinates for the picture, leave --texture out");
  }
  progress.start_stage("writing");
  const auto file = CGAL::Surface_mesh_multiresolution::encode_progressive_mesh(model);
  if(!file.error.empty()) {
    throw Program_error(options.input, file.error);
  }
  folder.create("index.html").put(page);
  folder.create("stream.wasm").put(reader);
  folder.create("model.pm").put(file.bytes);
  folder.create("texture.png").put(texture);
  const auto sizes = folder.sizes();
  Interruption::finish();
  folder.files().commit();
  progress.erase();
  if(!options.is_quiet) {
    print_notes(options.input, report.repairs, report.warnings);
    for(const auto& [name, size] : sizes) {
      std::cout << "written     " << name << " (" << size << " bytes)\n";
    }
    std::cout << "look at it  python3 -m http.server --directory '" << options.output
              << "', then http://localhost:8000\n" << std::flush;
  }
  return 0;
}

} // namespace hlscm
