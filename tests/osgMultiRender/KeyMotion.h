// SPDX-License-Identifier: MIT
#pragma once

/// How key points of a benchmark move from frame to frame.
enum class KeyMotion
{
    Rest,
    Dragged, ///< One of them.
    Moving   ///< All.
};

constexpr KeyMotion AllKeyMotions[] = {KeyMotion::Rest, KeyMotion::Dragged, KeyMotion::Moving};
constexpr const char* KeyMotionNames[] = {"", " dragged", " moving"};
