/* The breadth-first search. */
#include "graph.h"
#include "pipeline.h"
#include "standstill.h"

/* Why a slice of the search ends. */
enum end { FINISHED, SLICE, STATES, CUT, MEMORY, STOPPED, AT_FIRST };

struct figures {
    uint64_t states, transitions, expanded, depth, level, dropped, events, initials;
    struct cut cut;
};

/* --- its life */

static void make_packed(struct search *s)
{
    s->fields = zeroed(s->escape, s->rebecs, sizeof *s->fields);
    lay_out(s, s->fields, &s->words);
    s->batch = make_batch(s, BATCH);
    s->ids = zeroed(s->escape, s->rebecs, sizeof *s->ids);
    s->unpacked = zeroed(s->escape, s->rebecs, sizeof *s->unpacked);
}

static void measure_nothing(struct search *s)
{
    for (int32_t i = 0; i < s->model->measures; i++)
        s->measured[i] = (struct measured){0, -1, 0, -1, -1};
}

void rebsync_free(struct search *s)
{
    void *parts[] = {
        s->fields, s->ids, s->unpacked, s->events.data, s->states.data,
        s->parents.data, s->times.data, s->table, s->invariants, s->faults, s->measured};
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++)
        free(parts[i]);
    free_batch(&s->batch);
    free_prints(&s->prints);
    free_trail(&s->trail);
    free_frontier(&s->frontier);
    free_pipeline(s->pipeline);
    kernel_free(s->kernel);
    free(s);
}

struct search *rebsync_new(const struct model *model, int semantics, int compact,
                           const int32_t *invariants, int invariant_count,
                           const int32_t *persistent, int persistent_count)
{
    struct search *s = zeroed_lines(1, sizeof *s);
    if (!s)
        return NULL;
    s->model = model;
    s->rebecs = (uint32_t)model->rebecs;
    s->compact = compact;
    s->until = NEVER;
    s->escape = &s->outermost;
    if (setjmp(s->escape->to)) {
        rebsync_free(s);
        return NULL;
    }
    s->kernel = kernel_new(model, semantics, compact);
    if (!s->kernel || !kernel_persistent(s->kernel, persistent, persistent_count))
        give_up(s->escape);
    if (compact && !((s->trail.file = tmpfile()) && make_frontier(&s->frontier, s->rebecs)))
        give_up(s->escape);
    make_packed(s);
    kernel_meet(s->kernel, meet, s);
    s->invariants = copied(s->escape, invariants, (size_t)invariant_count);
    s->invariant_count = (uint32_t)invariant_count;
    s->measured = zeroed(s->escape, (size_t)model->measures, sizeof *s->measured);
    measure_nothing(s);
    return s;
}

/* Lets two threads search from now on, if there is memory for that. */
void rebsync_two_threads(struct search *s)
{
    if (!setjmp(s->escape->to)) {
        make_pipeline(s);
        return;
    }
    free_pipeline(s->pipeline);
    s->pipeline = NULL;
}

/* Lets the search reduce states to canonical ones, with the tables of orbits.h; 0 without memory. */
int rebsync_symmetry(struct search *s, struct symmetries found, const int32_t *names,
                     const int32_t *origins, const int32_t *positions, const int32_t *orbit,
                     const int32_t *references)
{
    s->symmetric = 1;
    return kernel_symmetry(s->kernel, found, names, origins, positions, orbit, references);
}

/* --- searching */

/* The initial states are stored. */
static void begun(struct search *s)
{
    s->level_end = s->initials = s->count;
    s->beginning = 0;
}

/* Stores the initial states; 0 when a constructor does not end. */
static int begin(struct search *s)
{
    s->beginning = 1;
    enum answer answer = kernel_initial(s->kernel, store, s);
    if (answer == UNENDING)
        return 0;
    expect(s, answer);
    flush(s);
    begun(s);
    return 1;
}

/* Forgets what was stored of initial states when one of them is never complete. */
static void undo(struct search *s)
{
    s->count = s->batch.count = s->dropped = 0;
    s->parents.count = s->times.count = s->events.count = 0;
    free_prints(&s->prints);
    s->frontier.tail.count = 0;
    if (s->compact)
        clear_trail(&s->trail);
    s->slots = 0;
    measure_nothing(s);
}

/* Enters the next level, when the last one is expanded; 0 when there is none. */
static int go_deeper(struct search *s)
{
    flush(s);
    if (s->expanded == s->count)
        return 0;
    s->depth++;
    s->level_end = s->count;
    return 1;
}

static enum answer expand_one(struct search *s)
{
    size_t made;
    unpack(s, front(s), s->ids);
    enum answer answer = kernel_successors(s->kernel, s->ids, 1, &made, store, s);
    s->expanded += made;
    s->frontier.head.expanded += made;
    return answer;
}

static int search_on(struct search *s, uint64_t states, int64_t due)
{
    for (uint64_t turn = 1;; turn++) {
        if (s->expanded == s->level_end && !go_deeper(s))
            return FINISHED;
        if (s->count + s->batch.count >= states) {
            flush(s);
            if (s->count >= states)
                return STATES;
        }
        int two = is_for_two(s);
        if ((two || turn % TURNS == 0) && clock_now() >= due)
            return SLICE;
        enum answer answer = two ? search_round(s, states) : expand_one(s);
        if (answer == UNENDING) {
            flush(s);
            return CUT;
        }
        expect(s, answer);
        if (s->compact && turn % TURNS == 0) {
            flush(s);
            tidy(s);
        }
    }
}

/* What was found is still to be told, which takes memory too: the table of states can go. */
static void exhaust(struct search *s)
{
    free(s->table);
    s->table = NULL;
    free_prints(&s->prints);
    s->batch.count = 0;
    s->exhausted = 1;
    if (s->beginning)
        begun(s);
}

/* Leaves what was found so far; the state that was expanded is not. */
static void stop(struct search *s)
{
    s->stopped = 1;
    flush(s);
    if (s->beginning)
        begun(s);
}

/* What is asked now and then, by searches and by what is done afterwards; NULL asks nobody. */
void rebsync_watch(struct search *s, void (*look)(int *goes_on))
{
    s->look = look;
    kernel_watch(s->kernel, look);
}

/* From now on the first violation ends the search: a failure, one of these predicates that is false,
 * or a deadlock if that is one. */
void rebsync_stop_at_first(struct search *s, const int32_t *faults, int count, int deadlock)
{
    free(s->faults);
    s->faults = NULL;
    s->first = s->deadlock_is_fault = 0;
    if (setjmp(s->escape->to))
        return;
    s->faults = copied(s->escape, faults, (size_t)count);
    s->fault_count = (uint32_t)count;
    s->deadlock_is_fault = deadlock;
    s->first = 1;
}

/* Searches for about so many nanoseconds, until `states` are found, up to the time `until`; a body
 * may run so many instructions. */
int rebsync_search(struct search *s, uint64_t states, int64_t until, int64_t instructions,
                   int64_t nanoseconds)
{
    int64_t due = clock_now() + nanoseconds;
    s->until = until;
    kernel_limit(s->kernel, instructions);
    int escaped = setjmp(s->escape->to);
    if (escaped == NO_MEMORY)
        exhaust(s);
    if (escaped == INTERRUPTED)
        stop(s);
    if (escaped == VIOLATED && s->beginning)
        begun(s);
    if (s->violated)
        return AT_FIRST;
    if (s->exhausted)
        return MEMORY;
    if (s->stopped)
        return STOPPED;
    if (!s->initials && !begin(s)) {
        undo(s);
        return CUT;
    }
    int end = search_on(s, states, due);
    flush(s);
    return end;
}

/* --- afterwards */

void rebsync_figures(struct search *s, struct figures *f)
{
    f->states = s->count;
    f->transitions = s->transitions;
    f->expanded = s->expanded;
    f->level = s->depth;
    f->depth = s->depth + (s->count > s->level_end);
    f->dropped = s->dropped;
    f->events = s->events.count;
    f->cut = kernel_cut(s->kernel);
    f->initials = s->initials;
}

const struct event *rebsync_events(struct search *s)
{
    return (struct event *)s->events.data;
}

const struct measured *rebsync_measured(struct search *s)
{
    return s->measured;
}

/* Copies which servers and branches ran, and the largest bags. */
void rebsync_covered(struct search *s, unsigned char *served, unsigned char *covered, uint32_t *largest)
{
    kernel_covered(s->kernel, served, covered, largest);
}

/* The first step from a state to another, and where it is sought. */
struct way {
    struct search *search;
    uint64_t from, to;
    int64_t code; /* -1: not found yet */
};

static void find_way(void *visitor, const struct transition *step)
{
    struct way *w = visitor;
    struct search *s = w->search;
    if (w->code >= 0 || !step->state || !is_state(s, step->state, (int64_t)w->to))
        return;
    int64_t before = s->times.count ? ((int64_t *)s->times.data)[w->from] : 0;
    if (!s->times.count || before + step->time <= s->until)
        w->code = (int64_t)step->code;
}

/* The state before one on its shortest way, or -1; `code` is that of the step between. It is -2
 * when there is no memory to find out, or the file of steps cannot be read. */
int64_t rebsync_before(struct search *s, uint64_t state, int64_t *code)
{
    if (s->compact) {
        struct arrival arrival = {0};
        if (!read_arrival(&s->trail, state, &arrival))
            return -2;
        *code = (int64_t)arrival.code;
        return state < s->initials ? -1 : (int64_t)arrival.parent;
    }
    uint32_t parent = ((uint32_t *)s->parents.data)[state];
    if (state < s->initials) {
        *code = parent;
        return -1;
    }
    size_t made;
    struct way way = {s, parent, state, -1};
    unpack(s, words_of(s, parent), s->ids);
    if (kernel_successors(s->kernel, s->ids, 1, &made, find_way, &way) != COMPLETE)
        return -2;
    *code = way.code;
    return parent;
}

/* Expands states again, from number `from` up to `to`, into arrays that are large enough; gives
 * how many edges there are so far, or -1 without memory. */
int64_t rebsync_graph(struct search *s, struct graph graph, uint64_t from, uint64_t to, uint64_t edges)
{
    uint32_t words = s->model->predicates ? (uint32_t)(s->model->predicates + 63) / 64 : 1;
    struct drawing drawing = {s, graph, s->symmetric, edges, from, from};
    size_t made;
    if (setjmp(s->escape->to))
        return -1;
    if (!s->table)
        fill_table(s, 2 * s->count + 1);
    for (uint64_t state = from; state < to; state++) {
        unpack(s, words_of(s, state), s->ids);
        label(s, graph.labels + state * words, words);
        drawing.from = state;
        if (state < s->expanded)
            expect(s, kernel_successors(s->kernel, s->ids, 1, &made, draw, &drawing));
    }
    flush_steps(&drawing);
    begin_steps(&drawing, to);
    return (int64_t)drawing.edges;
}

/* One library: what steps are is in here, and none of the above sees it. */
#include "kernel.c"
