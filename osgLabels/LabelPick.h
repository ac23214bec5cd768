// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <mutex>
#include <optional>

namespace osgLabels
{

/// A question for the object under a point of a picture, which a view answers when it is drawn.
/// Thread safe.
class LabelPick
{
public:
    /// `x` and `y` from -1 to 1 over the view, from its lower left corner.
    struct Point
    {
        double x = 0.0, y = 0.0;
    };

    /// Asks; an older question is forgotten.
    void ask(const Point& point)
    {
        std::lock_guard<std::mutex> lock(_mutex);
        _question = point;
        _answer.reset();
    }
    /// For the view that is drawn next.
    std::optional<Point> takeQuestion()
    {
        std::lock_guard<std::mutex> lock(_mutex);
        std::optional<Point> question;
        question.swap(_question);
        return question;
    }
    /// 0: nothing labelled is there.
    void answer(std::uint32_t identifier)
    {
        std::lock_guard<std::mutex> lock(_mutex);
        _answer = identifier;
    }
    std::optional<std::uint32_t> takeAnswer()
    {
        std::lock_guard<std::mutex> lock(_mutex);
        std::optional<std::uint32_t> answer;
        answer.swap(_answer);
        return answer;
    }

private:
    std::mutex _mutex;
    std::optional<Point> _question;
    std::optional<std::uint32_t> _answer;
};

} // namespace osgLabels
