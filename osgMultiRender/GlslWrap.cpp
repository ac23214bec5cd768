// SPDX-License-Identifier: MIT
#include <osgMultiRender/GlslWrap.h>

#include <osgMultiRender/GlslFragment.h>
#include <osgMultiRender/GlslPreprocessor.h>
#include <osgMultiRender/GlslRaise.h>

#include <algorithm>
#include <cctype>

namespace osgMultiRender
{

namespace
{

/// A text that is raised still asks for the version that its author wrote it for.
std::string withOwnVersion(const std::string& text, const GlslVersion& target)
{
    static const std::string macro = "__VERSION__";
    if (text.find(macro) == std::string::npos)
    {
        return text;
    }
    const std::vector<GlslToken> tokens = tokenize(text);
    const int own = readVersion(text, tokens).number;
    if (own >= target.number)
    {
        return text;
    }
    // In directives and in code alike; that comments change too does no harm.
    const auto isWord = [](char c)
    { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; };
    std::string result;
    std::size_t from = 0;
    for (std::size_t at; (at = text.find(macro, from)) != std::string::npos;)
    {
        const std::size_t end = at + macro.size();
        const bool whole =
            (at == 0 || !isWord(text[at - 1])) && (end == text.size() || !isWord(text[end]));
        result.append(text, from, at - from);
        result += whole ? std::to_string(own) : macro;
        from = end;
    }
    return result.append(text, from, std::string::npos);
}

/// The work of one wrapProgram().
class Wrapper
{
public:
    Wrapper(const std::vector<GlslShader>& shaders, const GlslVersion& target, bool isOurs)
        : _shaders(shaders), _target(target), _isOurs(isOurs)
    {
        for (GlslShader& shader : _shaders)
        {
            shader.text = withOwnVersion(shader.text, target);
        }
    }

    GlslWrapped run()
    {
        _result.version = _target;
        if (_target.number < 330 || _target.profile == GlslVersion::Profile::Es)
        {
            sayAll("GLSL 330 or later is needed, not " + toString(_target));
            return std::move(_result);
        }
        parse();
        checkVersions();
        GlslRaise raise = planRaise(_shaders, _sources, _target);
        append(_result.errors, raise.errors);
        readFragments();
        if (_result.errors.empty())
        {
            writeTexts(raise);
        }
        _result.ok = _result.errors.empty();
        if (!_result.ok)
        {
            _result.texts.clear();
            _result.outputs.clear();
        }
        return std::move(_result);
    }

private:
    static void append(std::vector<GlslWrapMessage>& to, const std::vector<GlslWrapMessage>& from)
    {
        to.insert(to.end(), from.begin(), from.end());
    }

    void sayAll(const std::string& message)
    {
        _result.errors.push_back({_shaders.size(), {0, 0, message}});
    }

    void parse()
    {
        for (std::size_t i = 0; i < _shaders.size(); ++i)
        {
            const std::string& text = _shaders[i].text;
            const int own = readVersion(text, tokenize(text)).number;
            _sources.push_back(parseGlsl(text, std::max(own, _target.number)));
            for (const GlslMessage& message : _sources.back().messages)
            {
                _result.warnings.push_back({i, message});
            }
        }
    }

    void checkVersions()
    {
        for (std::size_t i = 0; i < _sources.size(); ++i)
        {
            const GlslSource& source = _sources[i];
            if (source.version.profile == GlslVersion::Profile::Es)
            {
                _result.errors.push_back({i, {0, 0, "GLSL ES is not supported"}});
            }
            for (std::size_t token = 0; token < source.tokens.size(); ++token)
            {
                if (source.uses[token].kind != GlslUse::Kind::None &&
                    source.word(token).substr(0, 6) == "osgmr_" && !_isOurs)
                {
                    const GlslToken& at = source.tokens[token];
                    _result.errors.push_back(
                        {i, {at.line, at.column, "names that begin with 'osgmr_' are reserved"}});
                    break;
                }
            }
        }
    }

    void readFragments()
    {
        std::size_t mains = 0;
        bool any = false;
        for (std::size_t i = 0; i < _sources.size(); ++i)
        {
            _fragments.emplace_back(_sources[i], i);
            if (_shaders[i].stage != GlslStage::Fragment)
            {
                continue;
            }
            any = true;
            GlslFragment& fragment = _fragments.back();
            fragment.read(_result);
            mains += fragment.definesMain() ? 1 : 0;
        }
        if (!any)
        {
            sayAll("the program has no fragment shader");
        }
        else if (mains != 1)
        {
            sayAll(mains ? "several fragment shader objects define main"
                         : "no fragment shader object defines main");
        }
        mergeFragmentBuiltins(_fragments, _result);
    }

    void writeTexts(const GlslRaise& raise)
    {
        for (std::size_t i = 0; i < _sources.size(); ++i)
        {
            const GlslSource& source = _sources[i];
            GlslEdit edit(source);
            const bool raised = mustRaise(source, _target);
            if (raised)
            {
                raiseDirectives(source, _target, edit);
                edit.renameWords(raise.words);
            }
            GlslEdit::Names names = raise.functions[i];
            if (_shaders[i].stage == GlslStage::Fragment)
            {
                _fragments[i].edit(edit, names);
            }
            edit.rename(names);
            const GlslVersion version = raisedVersion(source, _target);
            _result.texts.push_back(edit.getText(version.number));
            _result.version.number = std::max(_result.version.number, version.number);
        }
        for (GlslOutput& output : _result.outputs)
        {
            const auto renamed = raise.words.find(output.variable);
            output.variable = renamed == raise.words.end() ? output.variable : renamed->second;
        }
    }

    std::vector<GlslShader> _shaders;
    GlslVersion _target;
    bool _isOurs;
    std::vector<GlslSource> _sources;
    std::vector<GlslFragment> _fragments;
    GlslWrapped _result;
};

} // namespace

GlslWrapped wrapProgram(const std::vector<GlslShader>& shaders, const GlslVersion& target,
                        bool isOurs)
{
    return Wrapper(shaders, target, isOurs).run();
}

std::string toString(const GlslVersion& version)
{
    const std::string profile = toString(version.profile);
    return std::to_string(version.number) + (profile.empty() ? "" : " " + profile);
}

} // namespace osgMultiRender
