/* The breadth-first search: everything that does not depend on the model. */
#include <time.h>

#include "expansion.h"
#include "standstill.h"

/* Why a slice of the search ends. */
enum end { FINISHED, SLICE, STATES, UNENDING, MEMORY, STOPPED, AT_FIRST };

struct figures {
    uint64_t states, transitions, expanded, depth, level, dropped, events, initials;
    struct cut cut;
};

/* --- beginning */

static void make_local(struct engine *e, struct local *l)
{
    size_t variables = 1;
    for (uint32_t r = 0; r < e->rebecs; r++) {
        size_t cells = (size_t)e->model->rebec[r].cells;
        variables = cells > variables ? cells : variables;
    }
    l->variables = zeroed(e, variables, sizeof(cell));
    room_for_bag(e, l, 1);
    l->message = zeroed(e, e->model->stride, sizeof(cell));
}

static void make_observed(struct engine *e)
{
    e->views = zeroed(e, e->rebecs, sizeof *e->views);
    e->machine.states = e->views;
    e->observed = zeroed(e, e->rebecs, sizeof *e->observed);
    for (uint32_t r = 0; r < e->rebecs; r++) {
        if (!e->model->observed[r])
            continue;
        size_t cells = (size_t)OBSERVED * e->model->rebec[r].cells;
        e->observed[r].variables = zeroed(e, cells, sizeof(cell));
        memset(e->observed[r].ids, 255, sizeof e->observed[r].ids);
    }
}

static void make_actors(struct engine *e)
{
    e->actors = zeroed(e, e->rebecs, sizeof *e->actors);
    e->fields = zeroed(e, e->rebecs, sizeof *e->fields);
    lay_out(e, e->fields, &e->words);
    for (uint32_t r = 0; r < e->rebecs; r++) {
        enlarge_memo(e, &e->actors[r].received, 1);
        enlarge_memo(e, &e->actors[r].passed, 1);
    }
    e->batch_words = zeroed(e, BATCH * e->words, sizeof *e->batch_words);
    e->ids = zeroed(e, e->rebecs, sizeof *e->ids);
    e->next = zeroed(e, e->rebecs, sizeof *e->next);
    e->unpacked = zeroed(e, e->rebecs, sizeof *e->unpacked);
}

static void make_machine(struct engine *e)
{
    const struct model *m = e->model;
    e->covered = zeroed(e, 2 * (size_t)m->branches, 1);
    e->uncounted = zeroed(e, 2 * (size_t)m->branches, 1);
    e->served = zeroed(e, (size_t)m->servers, 1);
    make_local(e, &e->scratch);
    make_local(e, &e->result);
    e->machine.variables = e->result.variables;
    e->machine.covered = e->covered;
    e->machine.stride = m->stride;
    e->machine.splits = e->semantics == TTS;
    e->machine.message = e->scratch.message;
    e->machine.engine = e;
    e->machine.more = more;
    for (uint32_t r = 0; r < e->rebecs; r++)
        e->machine.places += m->rebec[r].capacity;
}

void rebsync_free(struct engine *e)
{
    for (uint32_t r = 0; e->actors && r < e->rebecs; r++) {
        struct actor *a = e->actors + r;
        free(a->components.data);
        free(a->bytes.data);
        free(a->hashes.data);
        free(a->table);
        free(a->received.entries);
        free(a->passed.entries);
        free(a->renamed.entries);
    }
    for (uint32_t r = 0; e->observed && r < e->rebecs; r++)
        free(e->observed[r].variables);
    void *parts[] = {
        e->actors, e->observed, e->views, e->fields, e->batch_words, e->ids, e->next, e->unpacked,
        e->covered, e->uncounted, e->served, e->scratch.variables, e->scratch.bag,
        e->scratch.message, e->scratch.frames, e->result.variables, e->result.bag,
        e->result.message, e->result.frames, e->machine.stack, e->machine.frames,
        e->machine.choices, e->machine.options, e->machine.sends, e->text.data, e->messages.data,
        e->outcomes.data, e->sends.data, e->events.data, e->message_table, e->states.data,
        e->parents.data, e->times.data, e->table, e->invariants,
        e->persistent, e->names, e->origins,
        e->positions, e->orbit, e->references, e->colours, e->turned, e->faults, e->measured, e->watch.cells.data, e->watch.frames.data};
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++)
        free(parts[i]);
    free_prints(e);
    if (e->steps)
        fclose(e->steps);
    free(e);
}

static int32_t *copied(struct engine *e, const int32_t *numbers, size_t count)
{
    int32_t *copy = zeroed(e, count, sizeof *copy);
    memcpy(copy, numbers, count * sizeof *copy);
    return copy;
}

static void measure_nothing(struct engine *e)
{
    for (int32_t i = 0; i < e->model->measures; i++)
        e->measured[i] = (struct measured){0, -1, 0, -1, -1};
}

struct engine *rebsync_new(const struct model *model, int semantics, int compact,
                           const int32_t *invariants, int invariant_count,
                           const int32_t *persistent, int persistent_count)
{
    struct engine *e = calloc(1, sizeof *e);
    if (!e)
        return NULL;
    e->model = model;
    e->rebecs = (uint32_t)model->rebecs;
    e->semantics = semantics;
    e->compact = compact;
    e->until = NEVER;
    e->symmetries.order = 1;
    if (setjmp(e->escape)) {
        rebsync_free(e);
        return NULL;
    }
    e->collect_at = COLLECT;
    if (compact && !(e->steps = tmpfile()))
        give_up(e);
    make_actors(e);
    make_machine(e);
    make_observed(e);
    e->invariants = copied(e, invariants, (size_t)invariant_count);
    e->invariant_count = (uint32_t)invariant_count;
    e->measured = zeroed(e, (size_t)model->measures, sizeof *e->measured);
    measure_nothing(e);
    e->persistent = copied(e, persistent, (size_t)persistent_count * (e->rebecs + 1));
    e->persistent_count = (uint32_t)persistent_count;
    return e;
}

/* Lets the search reduce states to canonical ones, with the tables of orbits.h; 0 without memory. */
int rebsync_symmetry(struct engine *e, struct symmetries found, const int32_t *names,
                     const int32_t *origins, const int32_t *positions, const int32_t *orbit,
                     const int32_t *references)
{
    size_t rebecs = e->rebecs;
    if (setjmp(e->escape))
        return 0;
    e->names = copied(e, names, rebecs * (found.order + found.movable));
    e->origins = copied(e, origins, rebecs * found.order);
    e->positions = copied(e, positions, rebecs);
    e->orbit = copied(e, orbit, rebecs);
    e->references = (struct reference *)copied(e, references, 3 * (size_t)found.references);
    e->colours = zeroed(e, rebecs, sizeof *e->colours);
    e->turned = zeroed(e, rebecs, sizeof *e->turned);
    for (uint32_t r = 0; r < e->rebecs; r++)
        enlarge_memo(e, &e->actors[r].renamed, 1);
    e->symmetries = found;
    return 1;
}

/* --- searching */

static void begin(struct engine *e)
{
    uint32_t *ids = zeroed(e, e->rebecs, sizeof *ids);
    struct local *l = &e->result;
    for (uint32_t r = 0; r < e->rebecs; r++) {
        const struct rebec *rebec = e->model->rebec + r;
        memcpy(l->variables, rebec->blank, rebec->cells * sizeof(cell));
        l->busy = l->clock = 0;
        l->messages = l->frame_count = l->frame_cells = 0;
        ids[r] = number_of(e, r, l);
    }
    e->purpose = START;
    e->ordinal = 0;
    construct_from(e, ids, 0);
    flush(e);
    free(ids);
    e->level_end = e->initials = e->count;
    e->purpose = SEARCH;
}

/* Forgets what was stored of initial states when one of them is never complete. */
static void undo(struct engine *e)
{
    e->count = e->pending = e->dropped = 0;
    e->parents.count = e->times.count = e->events.count = 0;
    free_prints(e);
    if (e->compact)
        rewind(e->steps);
    e->slots = 0;
    measure_nothing(e);
}

/* Enters the next level, when the last one is expanded; 0 when there is none. */
static int go_deeper(struct engine *e)
{
    flush(e);
    if (e->expanded == e->count)
        return 0;
    e->depth++;
    e->level_end = e->count;
    return 1;
}

static int search_on(struct engine *e, uint64_t states, int64_t due)
{
    for (uint64_t turn = 1;; turn++) {
        if (e->expanded == e->level_end && !go_deeper(e))
            return FINISHED;
        if (e->count + e->pending >= states) {
            flush(e);
            if (e->count >= states)
                return STATES;
        }
        if (turn % TURNS == 0 && clock_now() >= due)
            return SLICE;
        e->current = e->expanded;
        unpack(e, words_of(e, e->current), e->ids);
        if (!expand(e)) {
            flush(e);
            return UNENDING;
        }
        e->expanded++;
        if (e->compact && turn % TURNS == 0) {
            flush(e);
            tidy(e);
        }
    }
}

/* What was found is still to be told, which takes memory too: the table of states can go. */
static void exhaust(struct engine *e)
{
    free(e->table);
    e->table = NULL;
    free_prints(e);
    e->pending = 0;
    e->exhausted = 1;
    if (e->purpose == START)
        e->initials = e->count;
}

/* Leaves what was found so far; the state that was expanded is not. */
static void stop(struct engine *e)
{
    e->stopped = 1;
    flush(e);
    if (e->purpose == START)
        e->initials = e->count;
}

/* What is asked now and then, by searches and by what is done afterwards; NULL asks nobody. */
void rebsync_watch(struct engine *e, void (*look)(int *goes_on))
{
    e->look = look;
    e->looked = clock_now();
}

/* From now on the first violation ends the search: a failure, one of these predicates that is false,
 * or a deadlock if that is one. */
void rebsync_stop_at_first(struct engine *e, const int32_t *faults, int count, int deadlock)
{
    free(e->faults);
    e->faults = NULL;
    e->first = e->deadlock_is_fault = 0;
    if (setjmp(e->escape))
        return;
    e->faults = copied(e, faults, (size_t)count);
    e->fault_count = (uint32_t)count;
    e->deadlock_is_fault = deadlock;
    e->first = 1;
}

/* Searches for about so many nanoseconds, until `states` are found, up to the time `until`; a body
 * may run so many instructions. */
int rebsync_search(struct engine *e, uint64_t states, int64_t until, int64_t instructions,
                   int64_t nanoseconds)
{
    e->looked = clock_now();
    int64_t due = e->looked + nanoseconds;
    e->until = until;
    e->instructions = instructions;
    int escaped = setjmp(e->escape);
    if (escaped == STUCK_AT_START)
        undo(e);
    if (escaped == NO_MEMORY)
        exhaust(e);
    if (escaped == ENDED)
        stop(e);
    if (escaped == VIOLATED && e->purpose == START)
        e->level_end = e->initials = e->count;
    if (e->violated)
        return AT_FIRST;
    if (e->exhausted)
        return MEMORY;
    if (e->stopped)
        return STOPPED;
    if (escaped)
        return UNENDING;
    if (!e->initials)
        begin(e);
    int end = search_on(e, states, due);
    flush(e);
    return end;
}

/* --- afterwards */

void rebsync_figures(struct engine *e, struct figures *f)
{
    f->states = e->count;
    f->transitions = e->transitions;
    f->expanded = e->expanded;
    f->level = e->depth;
    f->depth = e->depth + (e->count > e->level_end);
    f->dropped = e->dropped;
    f->events = e->events.count;
    f->cut = e->cut;
    f->initials = e->initials;
}

const struct event *rebsync_events(struct engine *e)
{
    return (struct event *)e->events.data;
}

const struct measured *rebsync_measured(struct engine *e)
{
    return e->measured;
}

/* Copies which servers and branches ran, and the largest bags. */
void rebsync_covered(struct engine *e, unsigned char *served, unsigned char *covered, uint32_t *largest)
{
    memcpy(served, e->served, (size_t)e->model->servers);
    memcpy(covered, e->covered, 2 * (size_t)e->model->branches);
    for (uint32_t r = 0; r < e->rebecs; r++)
        largest[r] = e->actors[r].largest;
}

/* The state before one on its shortest way, or -1; `code` is that of the step between. It is -2
 * when there is no memory to find out, or the file of steps cannot be read. */
int64_t rebsync_before(struct engine *e, uint64_t state, int64_t *code)
{
    if (e->compact) {
        struct step step;
        if (!read_step(e, state, &step))
            return -2;
        *code = step.code;
        return step.parent == NONE ? -1 : (int64_t)step.parent;
    }
    uint32_t parent = ((uint32_t *)e->parents.data)[state];
    if (state < e->initials) {
        *code = parent;
        return -1;
    }
    if (setjmp(e->escape)) {
        e->purpose = SEARCH;
        return -2;
    }
    e->purpose = PATH;
    e->current = parent;
    e->wanted = (int64_t)state;
    e->found = -1;
    unpack(e, words_of(e, parent), e->ids);
    expand(e);
    e->purpose = SEARCH;
    *code = e->found;
    return parent;
}

static void label(struct engine *e, uint64_t state, uint32_t words)
{
    uint64_t *labels = e->graph.labels + state * words;
    memset(labels, 0, words * sizeof *labels);
    observe_all(e, e->ids);
    for (int32_t p = 0; p < e->model->predicates; p++)
        if (holds(e, p) == 1)
            labels[p / 64] |= UINT64_C(1) << p % 64;
}

/* Expands states again, from number `from` up to `to`, into arrays that are large enough; gives
 * how many edges there are so far, or -1 without memory. */
int64_t rebsync_graph(struct engine *e, struct graph graph, uint64_t from, uint64_t to, uint64_t edges)
{
    uint32_t words = e->model->predicates ? (uint32_t)(e->model->predicates + 63) / 64 : 1;
    if (setjmp(e->escape)) {
        e->purpose = SEARCH;
        return -1;
    }
    if (!e->table)
        fill_table(e, 2 * e->count + 1);
    e->graph = graph;
    e->edges = edges;
    e->purpose = GRAPH;
    for (uint64_t state = from; state < to; state++) {
        e->current = state;
        unpack(e, words_of(e, state), e->ids);
        label(e, state, words);
        e->graph.first[state] = e->edges;
        if (state < e->expanded)
            expand(e);
    }
    e->graph.first[to] = e->edges;
    e->purpose = SEARCH;
    return (int64_t)e->edges;
}
