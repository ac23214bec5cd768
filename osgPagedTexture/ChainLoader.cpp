// SPDX-License-Identifier: MIT
#include <osgPagedTexture/ChainLoader.h>

#include <osgPagedTexture/ChainSource.h>
#include <osgPagedTexture/MemoryBudget.h>
#include <osgPagedTexture/WorkerPool.h>

#include <algorithm>
#include <deque>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

namespace osgPagedTexture
{

namespace
{

/// A file that is damaged and was written this short a time ago may still be on its way.
constexpr std::int64_t RecentNanoseconds = 10000000000;

/// `before`: of the file when it last failed as damaged. One that has not changed since is damaged
/// for good, however young it is.
bool isRetried(const ImageError& error, const std::optional<FileStamp>& now,
               const std::optional<FileStamp>& before)
{
    if (error.getKind() != ImageError::Kind::Damaged)
    {
        return error.getKind() == ImageError::Kind::Unreadable;
    }
    return !now || (now->modified + RecentNanoseconds > wallClock() && now != before);
}

using RequestKey = std::tuple<std::string, std::string, int, int>;

RequestKey keyOf(const ChainRequest& request)
{
    return {request.file, request.recipe->settings, request.firstLevel, request.previewSide};
}

struct Ticket
{
    ChainRequest request;
    unsigned int callers = 1;
    WorkerPool::JobId job = 0;
    std::size_t attempts = 0; ///< That failed.
    std::optional<FileStamp> damagedAs{};
    bool previewDone = false;

    bool wantsPreview() const { return request.previewSide > 0 && !previewDone; }
    JobPriority priority() const { return {wantsPreview() ? 1 : 0, request.priority}; }
};

} // namespace

/// What the threads share. The pool is its last member, so its threads end before the rest goes.
class ChainLoader::State
{
public:
    explicit State(const ChainLoaderSettings& settings)
        : retrySeconds(settings.retrySeconds), memory(settings.memoryBytes),
          source(settings, memory), pool(settings.threads)
    {
    }

    struct Ready
    {
        ChainResult result;
        MemoryBudget::Reservation memory;
    };

    void schedule(RequestId id, Ticket& ticket, double delaySeconds);
    void work(RequestId id, const std::atomic<bool>& cancelled);
    void load(RequestId id, const std::atomic<bool>& cancelled);
    void finish(RequestId id, ChainSource::Result loaded);
    void name(const std::string& file, const std::string& error);
    void fail(RequestId id, const std::string& error, bool retried,
              const std::optional<FileStamp>& stamp = {});

    const std::vector<double> retrySeconds;
    MemoryBudget memory;
    ChainSource source;

    std::mutex mutex;                    ///< Guards what follows; never held while a file is read.
    std::map<RequestId, Ticket> tickets; ///< Until their end is taken.
    std::map<RequestKey, RequestId> ids;
    std::deque<Ready> ready;
    std::set<std::string> failedFiles;
    std::vector<std::string> messages;
    Statistics statistics;
    RequestId lastId = 0;
    std::size_t ended = 0; ///< Tickets whose end waits to be taken.

    WorkerPool pool;
};

void ChainLoader::State::schedule(RequestId id, Ticket& ticket, double delaySeconds)
{
    ticket.job = pool.submit(
        ticket.priority(), [this, id](const std::atomic<bool>& cancelled) { work(id, cancelled); },
        delaySeconds);
}

void ChainLoader::State::work(RequestId id, const std::atomic<bool>& cancelled)
{
    try
    {
        load(id, cancelled);
    }
    catch (const std::bad_alloc&)
    {
        fail(id, "there is not enough memory for a picture; store it smaller", false);
    }
}

void ChainLoader::State::load(RequestId id, const std::atomic<bool>& cancelled)
{
    std::unique_lock<std::mutex> lock(mutex);
    const auto found = tickets.find(id);
    if (found == tickets.end())
    {
        return;
    }
    const ChainRequest request = found->second.request;
    const bool wantPreview = found->second.wantsPreview();
    const std::optional<FileStamp> damagedAs = found->second.damagedAs;
    lock.unlock();
    try
    {
        finish(id, source.load(request, wantPreview, cancelled));
    }
    catch (const ImageError& error)
    {
        if (error.getKind() != ImageError::Kind::Cancelled)
        {
            const std::optional<FileStamp> now = stampOf(request.file);
            fail(id, error.what(), isRetried(error, now, damagedAs), now);
        }
    }
    catch (const std::bad_alloc&)
    {
        fail(id, "'" + request.file + "': there is not enough memory for it; store it smaller",
             false);
    }
    catch (const std::exception& exception)
    {
        fail(id, "'" + request.file + "': cannot be encoded: " + exception.what(), false);
    }
}

void ChainLoader::State::finish(RequestId id, ChainSource::Result loaded)
{
    const std::lock_guard<std::mutex> lock(mutex);
    const auto found = tickets.find(id);
    if (found == tickets.end()) // cancelled meanwhile
    {
        return;
    }
    Ticket& ticket = found->second;
    ticket.attempts = 0;
    loaded.warning.empty() ? void(failedFiles.erase(ticket.request.file))
                           : name(ticket.request.file, loaded.warning);
    ChainResult result;
    result.id = id;
    result.state = loaded.preview ? ChainResult::State::Preview : ChainResult::State::Complete;
    result.chain = std::move(loaded.chain);
    ready.push_back({std::move(result), std::move(loaded.memory)});
    if (loaded.preview)
    {
        ticket.previewDone = true;
        schedule(id, ticket, 0.0);
        return;
    }
    ++ended;
    ++statistics.completed;
}

/// Of what is wrong with a file, only the first line is told until it is right again.
void ChainLoader::State::name(const std::string& file, const std::string& error)
{
    if (failedFiles.insert(file).second)
    {
        messages.push_back("osgPagedTexture::ChainLoader: " + error);
    }
}

void ChainLoader::State::fail(RequestId id, const std::string& error, bool retried,
                              const std::optional<FileStamp>& stamp)
{
    const std::lock_guard<std::mutex> lock(mutex);
    const auto found = tickets.find(id);
    if (found == tickets.end())
    {
        return;
    }
    Ticket& ticket = found->second;
    if (retried && ticket.attempts < retrySeconds.size())
    {
        ++statistics.retried;
        ticket.damagedAs = stamp;
        schedule(id, ticket, retrySeconds[ticket.attempts++]);
        return;
    }
    name(ticket.request.file, error);
    ChainResult result;
    result.id = id;
    result.error = error;
    ready.push_back({std::move(result), {}});
    ++ended;
    ++statistics.failed;
}

ChainLoader::ChainLoader(ChainLoaderSettings settings) : _state(std::make_unique<State>(settings))
{
}

ChainLoader::~ChainLoader()
{
    // Nothing may be held that a job at work waits for.
    {
        const std::lock_guard<std::mutex> lock(_state->mutex);
        _state->tickets.clear();
        _state->ready.clear();
    }
    _state->pool.stop();
}

RequestId ChainLoader::request(const ChainRequest& request)
{
    State& state = *_state;
    const std::lock_guard<std::mutex> lock(state.mutex);
    ++state.statistics.requests;
    const auto [place, added] = state.ids.emplace(keyOf(request), state.lastId + 1);
    if (!added)
    {
        Ticket& ticket = state.tickets.at(place->second);
        ++ticket.callers;
        ticket.request.priority = std::max(ticket.request.priority, request.priority);
        state.pool.setPriority(ticket.job, ticket.priority());
        return place->second;
    }
    const RequestId id = ++state.lastId;
    try
    {
        Ticket& ticket = state.tickets[id];
        ticket.request = request;
        state.schedule(id, ticket, 0.0);
    }
    catch (...) // nobody would ever end it
    {
        state.tickets.erase(id);
        state.ids.erase(place);
        throw;
    }
    return id;
}

void ChainLoader::setPriority(RequestId id, double priority)
{
    const std::lock_guard<std::mutex> lock(_state->mutex);
    const auto found = _state->tickets.find(id);
    if (found != _state->tickets.end())
    {
        found->second.request.priority = priority;
        _state->pool.setPriority(found->second.job, found->second.priority());
    }
}

void ChainLoader::cancel(RequestId id)
{
    State& state = *_state;
    const std::lock_guard<std::mutex> lock(state.mutex);
    const auto found = state.tickets.find(id);
    if (found == state.tickets.end() || --found->second.callers > 0)
    {
        return;
    }
    state.pool.cancel(found->second.job);
    state.ids.erase(keyOf(found->second.request));
    state.tickets.erase(found);
    ++state.statistics.cancelled;
    const auto gone = [&](const State::Ready& ready)
    {
        state.ended -= ready.result.id == id && ready.result.state != ChainResult::State::Preview;
        return ready.result.id == id;
    };
    state.ready.erase(std::remove_if(state.ready.begin(), state.ready.end(), gone),
                      state.ready.end());
}

std::vector<ChainResult> ChainLoader::poll(std::size_t count)
{
    State& state = *_state;
    std::vector<ChainResult> results;
    const std::lock_guard<std::mutex> lock(state.mutex);
    results.reserve(std::min(count, state.ready.size()));
    while (!state.ready.empty() && results.size() < count)
    {
        ChainResult& result = state.ready.front().result;
        if (result.state != ChainResult::State::Preview)
        {
            const auto ticket = state.tickets.find(result.id);
            state.ids.erase(keyOf(ticket->second.request));
            state.tickets.erase(ticket);
            --state.ended;
        }
        results.push_back(std::move(result));
        state.ready.pop_front();
    }
    return results;
}

ChainLoader::Statistics ChainLoader::getStatistics() const
{
    const ChainSource::Counters& counters = _state->source.getCounters();
    const std::lock_guard<std::mutex> lock(_state->mutex);
    Statistics statistics = _state->statistics;
    statistics.filesDecoded = counters.filesDecoded;
    statistics.bytesRead = counters.bytesRead;
    statistics.pixelsDecoded = counters.pixelsDecoded;
    statistics.bytesEncoded = counters.bytesEncoded;
    statistics.memoryBytes = _state->memory.getHeld();
    statistics.peakMemoryBytes = _state->memory.getPeak();
    statistics.waiting = _state->tickets.size() - _state->ended;
    statistics.cache = _state->source.getCache().getStatistics();
    return statistics;
}

std::vector<std::string> ChainLoader::takeMessages()
{
    std::vector<std::string> messages = _state->source.getCache().takeMessages();
    const std::lock_guard<std::mutex> lock(_state->mutex);
    messages.insert(messages.end(), _state->messages.begin(), _state->messages.end());
    _state->messages.clear();
    return messages;
}

} // namespace osgPagedTexture
