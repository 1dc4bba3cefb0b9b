/* The breadth-first search. */
#include "afterwards.h"
#include "rounds.h"
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
    s->batch_words = zeroed(s->escape, BATCH * s->words, sizeof *s->batch_words);
    s->ids = zeroed(s->escape, s->rebecs, sizeof *s->ids);
    s->unpacked = zeroed(s->escape, s->rebecs, sizeof *s->unpacked);
}

void rebsync_free(struct search *s)
{
    void *parts[] = {
        s->fields, s->batch_words, s->ids, s->unpacked, s->judge->events.data, s->states.data,
        s->parents.data, s->times.data, s->table, s->taken, s->invariants, s->faults,
        s->judge->measured};
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++)
        free(parts[i]);
    free_prints(s);
    free_team(s->team);
    if (s->arrivals)
        fclose(s->arrivals);
    kernel_free(s->kernel);
    free(s);
}

struct search *rebsync_new(const struct model *model, int semantics, int compact,
                           const int32_t *invariants, int invariant_count,
                           const int32_t *persistent, int persistent_count)
{
    struct search *s = calloc(1, sizeof *s);
    if (!s)
        return NULL;
    s->model = model;
    s->rebecs = (uint32_t)model->rebecs;
    s->compact = compact;
    s->until = NEVER;
    s->collect_at = COLLECT;
    if (setjmp(s->escape->to)) {
        rebsync_free(s);
        return NULL;
    }
    s->kernel = kernel_new(model, semantics, compact);
    if (!s->kernel || !kernel_persistent(s->kernel, persistent, persistent_count))
        give_up(s->escape);
    if (compact && !(s->arrivals = tmpfile()))
        give_up(s->escape);
    make_packed(s);
    kernel_meet(s->kernel, meet, s);
    s->invariants = copied(s->escape, invariants, (size_t)invariant_count);
    s->invariant_count = (uint32_t)invariant_count;
    *s->judge = (struct judge){.search = s, .kernel = s->kernel, .escape = s->escape};
    s->judge->measured = zeroed(s->escape, (size_t)model->measures, sizeof *s->judge->measured);
    measure_nothing(s->judge);
    s->shares = 1;
    s->taken = zeroed(s->escape, 1, sizeof *s->taken);
    return s;
}

/* Lets so many threads search, before it begins; `semantics` and `persistent` as in rebsync_new. Not
 * with fingerprints. 0 without memory. */
int rebsync_team(struct search *s, uint32_t workers, int semantics, const int32_t *persistent,
                 int persistent_count)
{
    if (setjmp(s->escape->to))
        return 0;
    free(s->taken);
    s->taken = NULL;
    s->taken = zeroed(s->escape, workers, sizeof *s->taken);
    s->shares = workers;
    make_team(s, workers, semantics, persistent, persistent_count);
    return 1;
}

/* Lets the search reduce states to canonical ones, with the tables of orbits.h; 0 without memory. */
int rebsync_symmetry(struct search *s, struct symmetries found, const int32_t *names,
                     const int32_t *origins, const int32_t *positions, const int32_t *orbit,
                     const int32_t *references)
{
    s->symmetric = 1;
    int done = kernel_symmetry(s->kernel, found, names, origins, positions, orbit, references);
    for (uint32_t i = 0; done && s->team && i < s->team->workers; i++)
        done = kernel_symmetry(s->team->worker[i].kernel, found, names, origins, positions, orbit,
                               references);
    return done;
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
    expect(s->escape, answer);
    flush(s);
    begun(s);
    return 1;
}

/* Forgets what was stored of initial states when one of them is never complete. */
static void undo(struct search *s)
{
    s->count = s->pending = s->dropped = 0;
    s->parents.count = s->times.count = s->judge->events.count = 0;
    free_prints(s);
    if (s->compact)
        rewind(s->arrivals);
    s->slots = s->share_slots = 0;
    measure_nothing(s->judge);
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

static int search_on(struct search *s, uint64_t states, int64_t due)
{
    size_t made;
    for (uint64_t turn = 1;; turn++) {
        if (s->expanded == s->level_end && !go_deeper(s))
            return FINISHED;
        if (s->count + s->pending >= states) {
            flush(s);
            if (s->count >= states)
                return STATES;
        }
        if (turn % TURNS == 0 && clock_now() >= due)
            return SLICE;
        enum attempt attempt = expand_together(s, states, due);
        if (attempt == REFUSED)
            return STOPPED;
        if (attempt == EXPANDED) {
            turn = TURNS - 1;
            continue;
        }
        unpack(s, words_of(s, s->expanded), s->ids);
        enum answer answer = kernel_successors(s->kernel, s->ids, 1, &made, store, s);
        if (answer == UNENDING) {
            flush(s);
            return CUT;
        }
        expect(s->escape, answer);
        s->expanded++;
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
    free_prints(s);
    disband(s->team);
    s->pending = 0;
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

static int search_until(struct search *s, uint64_t states, int64_t due)
{
    int escaped = setjmp(s->escape->to);
    if (escaped == NO_MEMORY)
        exhaust(s);
    if (escaped == INTERRUPTED)
        stop(s);
    if (escaped == VIOLATED && s->beginning)
        begun(s);
    if (s->judge->violated)
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

/* Searches for about so many nanoseconds, until `states` are found, up to the time `until`; a body
 * may run so many instructions. */
int rebsync_search(struct search *s, uint64_t states, int64_t until, int64_t instructions,
                   int64_t nanoseconds)
{
    s->until = until;
    kernel_limit(s->kernel, instructions);
    for (uint32_t i = 0; s->team && !s->team->disbanded && i < s->team->workers; i++)
        kernel_limit(s->team->worker[i].kernel, instructions);
    int end = search_until(s, states, clock_now() + nanoseconds);
    end_threads(s->team);
    return end;
}

/* --- what was found */

void rebsync_figures(struct search *s, struct figures *f)
{
    f->states = s->count;
    f->transitions = s->transitions;
    f->expanded = s->expanded;
    f->level = s->depth;
    f->depth = s->depth + (s->count > s->level_end);
    f->dropped = s->dropped;
    f->events = s->judge->events.count;
    f->cut = kernel_cut(s->kernel);
    f->initials = s->initials;
}

const struct event *rebsync_events(struct search *s)
{
    return (struct event *)s->judge->events.data;
}

const struct measured *rebsync_measured(struct search *s)
{
    return s->judge->measured;
}

/* Copies which servers and branches ran, and the largest bags. */
void rebsync_covered(struct search *s, unsigned char *served, unsigned char *covered, uint32_t *largest)
{
    kernel_covered(s->kernel, served, covered, largest);
    if (s->team)
        add_covered(s->team, served, covered, largest);
}

/* One library: what steps are is in here, and none of the above sees it. */
#include "kernel.c"
