// SPDX-License-Identifier: MIT
#include <osgLabels/LabelBuffers.h>

#include <osgLabels/LabelUnits.h>

#include <array>

namespace osgLabels
{

namespace
{

struct BufferName
{
    int unit;
    const char* sampler;
};

/// By TableBuffer.
constexpr std::array<BufferName, 3> names = {{{TextsUnit, "osgLabels_texts"},
                                              {RowsUnit, "osgLabels_rows"},
                                              {StylesUnit, "osgLabels_styles"}}};

} // namespace

/// Draw thread of the context only, but for the traffic.
class LabelBuffers::Context : public LabelTable::Sink
{
public:
    Context(LabelTable& table, bool isPaged)
        : _isPaged(isPaged), _reader(table.makeReader()), _stateSet(new osg::StateSet),
          _layout(new osg::Uniform(osg::Uniform::UNSIGNED_INT_VEC4, "osgLabels_layout")),
          _styleCount(new osg::Uniform("osgLabels_styleCount", 0u))
    {
        constexpr auto over = osg::StateAttribute::OVERRIDE;
        for (const BufferName& name : names)
            _stateSet->addUniform(new osg::Uniform(name.sampler, name.unit), over);
        _stateSet->addUniform(_layout, over | osg::StateAttribute::ON);
        _stateSet->addUniform(_styleCount, over | osg::StateAttribute::ON);
    }

    osg::ref_ptr<const osg::StateSet> update(osg::State& state, LabelTable& table)
    {
        _state = &state;
        _sent = 0;
        _calls = 0;
        const TableLayout layout = table.take(*_reader, TextBytesPerFrame, *this);
        _layout->set(layout.bits, layout.shift, layout.probes ? layout.log2 : layout.rows,
                     layout.probes);
        _styleCount->set(layout.styles);
        _state = nullptr;
        return _stateSet;
    }

    bool resize(TableBuffer buffer, std::size_t bytes, unsigned int wordsPerTexel) override
    {
        const auto index = static_cast<std::size_t>(buffer);
        osg::ref_ptr<BufferTexture>& texture = _textures[index];
        if (!texture || texture->getWordsPerTexel() != wordsPerTexel)
        {
            texture = new BufferTexture(_state->getContextID(), wordsPerTexel, _isPaged);
            _stateSet->setTextureAttribute(static_cast<unsigned int>(names[index].unit), texture,
                                           osg::StateAttribute::OVERRIDE);
        }
        return texture->resize(*_state, bytes);
    }

    void write(TableBuffer buffer, std::size_t offset, const void* data, std::size_t bytes) override
    {
        _textures[static_cast<std::size_t>(buffer)]->write(*_state, offset, data, bytes);
        _sent += bytes;
        ++_calls;
    }

    bool isPaged() const { return _isPaged; }

    Traffic getTraffic() const
    {
        Traffic traffic;
        for (const auto& texture : _textures)
            traffic.bytesHeld += texture ? texture->getBytes() : 0;
        traffic.bytesSent = _sent;
        traffic.calls = _calls;
        return traffic;
    }

    void releaseGLObjects(osg::State* state) const { _stateSet->releaseGLObjects(state); }

private:
    const bool _isPaged;
    const std::shared_ptr<LabelTable::Reader> _reader;
    const osg::ref_ptr<osg::StateSet> _stateSet;
    const osg::ref_ptr<osg::Uniform> _layout, _styleCount;
    std::array<osg::ref_ptr<BufferTexture>, names.size()> _textures;
    osg::State* _state = nullptr; ///< While it takes changes.
    std::size_t _sent = 0;
    unsigned int _calls = 0;
};

LabelBuffers::LabelBuffers(std::shared_ptr<LabelTable> table, bool isPaged)
    : _table(std::move(table)), _isPaged(isPaged)
{
}

LabelBuffers::~LabelBuffers() = default;

std::shared_ptr<LabelBuffers::Context> LabelBuffers::get(osg::State& state)
{
    std::lock_guard<std::mutex> lock(_mutex);
    auto& context = _contexts[state.getContextID()];
    if (!context)
        context = std::make_shared<Context>(*_table, _isPaged || BufferTexture::needsPages(state));
    return context;
}

osg::ref_ptr<const osg::StateSet> LabelBuffers::update(osg::State& state)
{
    return get(state)->update(state, *_table);
}

bool LabelBuffers::isPaged(osg::State& state)
{
    return get(state)->isPaged();
}

LabelBuffers::Traffic LabelBuffers::getTraffic(unsigned int contextID) const
{
    std::lock_guard<std::mutex> lock(_mutex);
    const auto found = _contexts.find(contextID);
    return found == _contexts.end() ? Traffic() : found->second->getTraffic();
}

void LabelBuffers::releaseGLObjects(osg::State* state) const
{
    // The next update() makes a context anew, and gets the whole table.
    std::lock_guard<std::mutex> lock(_mutex);
    for (auto context = _contexts.begin(); context != _contexts.end();)
        if (!state || state->getContextID() == context->first)
        {
            context->second->releaseGLObjects(state);
            context = _contexts.erase(context);
        }
        else
            ++context;
}

} // namespace osgLabels
