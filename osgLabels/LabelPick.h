// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>

namespace osg
{
class Camera;
} // namespace osg

namespace osgLabels
{

class LabelResources;

/// A question for the object under a point of a picture, and its answer. Thread safe.
class LabelPick
{
public:
    struct Question
    {
        /// From -1 to 1 over the picture, from its lower left corner.
        double x = 0.0, y = 0.0;
        /// The camera whose picture is meant; null for that of any view. Only compared.
        const osg::Camera* camera = nullptr;
    };
    struct Answer
    {
        std::uint32_t identifier = 0; ///< 0: nothing labelled is there.
        /// Whose identifier it is; null for none.
        std::shared_ptr<const LabelResources> resources;
    };

    /// Asks; an older question is forgotten.
    void ask(const Question& question)
    {
        std::lock_guard<std::mutex> lock(_mutex);
        _question = question;
        _answer.reset();
    }
    /// The question, if it is for the picture of that camera; `isView` tells that this is what a
    /// view shows, not a picture in it, such as a mirror's.
    std::optional<Question> take(const osg::Camera* camera, bool isView)
    {
        std::lock_guard<std::mutex> lock(_mutex);
        const bool isMeant =
            _question && (_question->camera ? _question->camera == camera : isView);
        std::optional<Question> question;
        if (isMeant)
            question.swap(_question);
        return question;
    }
    /// What the next picture may answer instead: this one was not drawn.
    void giveBack(const Question& question)
    {
        std::lock_guard<std::mutex> lock(_mutex);
        if (!_question && !_answer)
            _question = question;
    }
    void answer(Answer answer)
    {
        std::lock_guard<std::mutex> lock(_mutex);
        if (!_question) // or it has been asked anew since
            _answer = std::move(answer);
    }
    std::optional<Answer> takeAnswer()
    {
        std::lock_guard<std::mutex> lock(_mutex);
        std::optional<Answer> answer;
        answer.swap(_answer);
        return answer;
    }

private:
    std::mutex _mutex;
    std::optional<Question> _question;
    std::optional<Answer> _answer;
};

/// Who asks: the application and the viewer's keys do not get each other's answers.
enum class PickAsker
{
    Application,
    Keys
};

/// The questions of a LabelScene, by PickAsker.
struct LabelPicks
{
    static constexpr std::size_t Askers = 2;
    LabelPick of[Askers];

    LabelPick& operator[](PickAsker asker) { return of[static_cast<std::size_t>(asker)]; }
};

} // namespace osgLabels
