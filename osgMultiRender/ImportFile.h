// SPDX-License-Identifier: MIT
// What the importers share. Not installed.
#pragma once

#include <osgMultiRender/Rendering.h>

#include <string>
#include <vector>

namespace osgMultiRender
{

/// Reads a text of at most 16 MiB, without a UTF-8 mark. False with the cause in `error`.
bool readTextFile(const std::string& fileName, std::string& text, std::string& error);

/// Adds "file: text" to the messages; `error` decides whether the rendering can be used.
void say(Rendering& rendering, bool error, const std::string& text);

/// The name of a file without folder and extension.
std::string baseName(const std::string& fileName);

/// The path of a file that a project names, with either slash; empty, with an error in
/// `rendering`, if it is absolute or lies outside of the parent of the project's folder.
std::string pathBeside(Rendering& rendering, const std::string& name);

/// Reads "1, 0.5 0" up to the first word that is no number. Infinite ones and NaN are left out.
std::vector<double> readNumbers(const std::string& text, std::size_t& at);

/// Reads what comments behind uniforms say.
void readUniformComments(Rendering& rendering);

/// Reads "name = 1, 2" lines.
void readUniformFile(Rendering& rendering, const std::string& text, const std::string& fileName);

/// The uniform of a name, made if it is new.
RenderingUniform& uniformOf(Rendering& rendering, const std::string& name);

} // namespace osgMultiRender
