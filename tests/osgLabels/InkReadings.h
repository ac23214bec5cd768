// SPDX-License-Identifier: MIT
#pragma once

#include "LabelPictures.h"

#include <string>

/// Measures of ink that chooses itself: which one each letter has, and how well it can be read.
namespace inkReadings
{

constexpr int Wide = 480, High = 360;

/// Of this process; its headlight is off.
support::HeadlessViewer& viewer();

double luminanceOf(const osg::Vec4& color);
double contrast(double a, double b);

/// What shows that a model's letters can be read.
struct Readings
{
    int letters = 0, black = 0, white = 0; ///< Black and white pixels of ink.
    int twoColored = 0;                    ///< Letters.
    double worst = 21.0;                   ///< Contrast of ink to what surrounds it.
};

/// Which pixels beside a letter have to keep the contrast.
enum class Beside
{
    All,
    /// Those that a plate of the text would cover. On bent surfaces with texture coordinates texts
    /// end where the surface turns away or its coordinates do, less than a pixel beside a letter:
    /// beyond that lies what is no text's, of any brightness.
    Plates
};

/// Compares the model's labels in ink that chooses itself with the same in a colour of their own.
/// Letters are what hangs together.
Readings readingsOf(osg::Node* model, const support::CameraSpec& camera, const std::string& name,
                    const std::string& settings = std::string(), Beside beside = Beside::All);

/// That each letter has one ink, and a contrast of 4.5 to what is around it.
void expectReadable(const Readings& found, const std::string& name, int leastLetters);

/// That, and that no pixel of the model has another ink.
void expectOneInk(const Readings& found, const std::string& name, int leastLetters);

} // namespace inkReadings
