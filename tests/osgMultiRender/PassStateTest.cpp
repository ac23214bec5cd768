// SPDX-License-Identifier: MIT
#include <osgMultiRender/PassState.h>

#include <osg/StateSet>

#include <gtest/gtest.h>

#include <new>

namespace
{

/// An attribute of which one at a time lives, always at the same place.
class Stamp : public osg::StateAttribute
{
public:
    explicit Stamp(int value = 0) : _value(value) {}
    Stamp(const Stamp& other, const osg::CopyOp& op = osg::CopyOp::SHALLOW_COPY)
        : osg::StateAttribute(other, op), _value(other._value)
    {
    }
    osg::Object* cloneType() const override { return ::new Stamp; }
    osg::Object* clone(const osg::CopyOp&) const override { return ::new Stamp(*this); }
    const char* libraryName() const override { return "tests"; }
    const char* className() const override { return "Stamp"; }
    Type getType() const override { return VIEWPORT; }
    int compare(const osg::StateAttribute& other) const override
    {
        return _value - static_cast<const Stamp&>(other)._value;
    }
    void apply(osg::State&) const override { last = _value; }

    static int last; ///< Of what was applied last.

private:
    const int _value;
};

int Stamp::last = 0;

alignas(Stamp) unsigned char place[sizeof(Stamp)];

/// Like Stamp; lies at `place`.
class PlacedStamp : public Stamp
{
public:
    using Stamp::Stamp;
    static void* operator new(std::size_t) { return place; }
    static void operator delete(void*) {}
};
static_assert(sizeof(PlacedStamp) <= sizeof(place));

void drawPass(osg::State& state, int value)
{
    osg::ref_ptr<osg::StateSet> stateSet = new osg::StateSet;
    stateSet->setAttribute(new PlacedStamp(value));
    const osgMultiRender::PassState pass(state, *stateSet);
    state.apply();
}

} // namespace

TEST(PassState, anAttributeThatLiesWhereADeadOneWasIsApplied)
{
    osg::ref_ptr<osg::State> state = new osg::State;
    drawPass(*state, 1);
    EXPECT_EQ(Stamp::last, 1);
    drawPass(*state, 2);
    EXPECT_EQ(Stamp::last, 2);
}

TEST(PassState, whatWasBelowIsAppliedAgain)
{
    osg::ref_ptr<osg::State> state = new osg::State;
    osg::ref_ptr<osg::StateSet> below = new osg::StateSet;
    below->setAttribute(::new Stamp(7));
    state->pushStateSet(below.get());
    state->apply();
    drawPass(*state, 2);
    EXPECT_EQ(Stamp::last, 2);
    state->apply();
    EXPECT_EQ(Stamp::last, 7);
}
