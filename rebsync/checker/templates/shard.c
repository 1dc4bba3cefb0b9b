/* One of several workers that search together, breadth first: it owns the states whose fingerprints
 * are its own.
 *
 * A level goes in four phases, between which all wait for each other. Each worker expands its states,
 * and writes what they lead to in a batch for each owner; the owner reads these, and keeps what is new
 * to it with the first way there; the ways of all workers are put in order, each range of parents by
 * one of them; and with its place in that order, which is the number that a search by one machine would
 * give it, a new state is judged and waits for the next level. */
#include "ranking.h"
#include "shard.h"

enum { PREDICATE = 8, DEADLOCK = 9 };

/* Something wrong: with the step to a state or a failure, and its place in the order of a search. */
struct finding {
    int32_t kind, pc, rebec;
    uint32_t code, place;
    uint64_t parent;
    int64_t state, ordinal;
};

/* A state whose steps were not all made: a body was given up. `number` is UINT64_MAX if there is none. */
struct unfinished {
    uint64_t number;
    struct cut cut;
};

struct shard_figures {
    uint64_t states, fresh, transitions, dropped, findings;
    struct unfinished unfinished;
};

struct shard {
    const struct model *model;
    struct kernel *kernel;
    uint32_t rebecs, shares;
    int compact;
    int64_t until;
    int32_t *invariants;
    uint32_t invariant_count;

    struct tuples seen; /* or, with `compact`, their fingerprints */
    struct fingerprints prints;
    struct batch waiting, fresh; /* states to be expanded; those that are reached and new */
    struct batch *sent;          /* for each owner */
    const struct record *from;   /* the state that is expanded; NULL: initial states are made */
    uint64_t ranked;             /* fresh states that have their numbers */

    struct writer writer;
    struct reader reader;
    struct vector ids, records, findings, numbers; /* what is read; what is wrong; numbers that change */
    size_t collect_at;
    struct shard_figures figures;
    struct escape escape[1];
};

static void begin_phase(struct shard *s)
{
    s->findings.count = 0;
    s->figures = (struct shard_figures){.unfinished = {UINT64_MAX}};
}

/* --- its life */

void rebsync_shard_free(struct shard *s)
{
    for (uint32_t i = 0; s->sent && i < s->shares; i++)
        free_batch(s->sent + i);
    free_batch(&s->waiting);
    free_batch(&s->fresh);
    free_tuples(&s->seen);
    free_prints(&s->prints);
    void *parts[] = {
        s->invariants, s->sent, s->writer.bytes.data, s->writer.marks.data, s->writer.locals.data,
        s->reader.numbers.data, s->ids.data, s->records.data, s->findings.data, s->numbers.data};
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++)
        free(parts[i]);
    kernel_free(s->kernel);
    free(s);
}

/* A worker of so many; NULL without memory. States later than `until` are left out. */
struct shard *rebsync_shard_new(const struct model *model, int semantics, int compact, int shares,
                                int64_t until, int64_t instructions, const int32_t *invariants,
                                int invariant_count, const int32_t *persistent, int persistent_count)
{
    struct shard *s = calloc(1, sizeof *s);
    if (!s)
        return NULL;
    s->model = model;
    s->rebecs = (uint32_t)model->rebecs;
    s->shares = (uint32_t)shares;
    s->compact = compact;
    s->until = until;
    s->collect_at = LEAST;
    if (setjmp(s->escape->to)) {
        rebsync_shard_free(s);
        return NULL;
    }
    s->kernel = kernel_new(model, semantics, 1);
    if (!s->kernel || !kernel_persistent(s->kernel, persistent, persistent_count))
        give_up(s->escape);
    kernel_limit(s->kernel, instructions);
    s->writer.kernel = s->reader.kernel = s->kernel;
    s->writer.escape = s->reader.escape = s->escape;
    s->invariants = copied(s->escape, invariants, (size_t)invariant_count);
    s->invariant_count = (uint32_t)invariant_count;
    s->sent = zeroed(s->escape, s->shares, sizeof *s->sent);
    begin_phase(s);
    return s;
}

/* --- expanding */

static void note(struct shard *s, struct finding found)
{
    const struct finding *known = (struct finding *)s->findings.data;
    for (size_t i = 0; i < s->findings.count; i++)
        if (known[i].kind == found.kind && known[i].pc == found.pc && known[i].rebec == found.rebec)
            return;
    *(struct finding *)added(s->escape, &s->findings, sizeof found) = found;
}

static void send(void *shard, const struct transition *step)
{
    struct shard *s = shard;
    uint64_t parent = s->from ? s->from->number : 0;
    if (step->code > UINT32_MAX)
        give_up(s->escape);
    struct record record = {.parent = parent, .code = (uint32_t)step->code, .deadlock = step->deadlock};
    if (s->until != NEVER && step->state) {
        record.time = step->time + (s->from ? s->from->time : 0);
        if (record.time > s->until) {
            s->figures.dropped++;
            return;
        }
    }
    s->figures.transitions += s->from != NULL;
    if (!step->state) {
        int64_t state = s->from ? (int64_t)parent : -1, code = (int64_t)step->code;
        note(s, (struct finding){step->kind, step->pc, step->rebec, record.code, 0, parent, state, code});
        return;
    }
    uint32_t owner = kernel_owner(kernel_fingerprint(s->kernel, step->state), s->shares);
    add_record(s->escape, s->sent + owner, s->rebecs, step->state, record);
}

/* A body was given up: what was sent by then stays. */
static void leave_unfinished(struct shard *s, uint64_t number)
{
    s->figures.unfinished = (struct unfinished){number, kernel_cut(s->kernel)};
}

/* Makes the initial states. All that follow give why they end: see enum answer. */
int rebsync_shard_begin(struct shard *s)
{
    begin_phase(s);
    s->from = NULL;
    int escaped = setjmp(s->escape->to);
    if (escaped)
        return escaped;
    enum answer answer = kernel_initial(s->kernel, send, s);
    if (answer == UNENDING)
        leave_unfinished(s, 0);
    return answer == UNENDING ? COMPLETE : answer;
}

/* Makes the steps of the states that wait. */
int rebsync_shard_expand(struct shard *s)
{
    begin_phase(s);
    int escaped = setjmp(s->escape->to);
    if (escaped)
        return escaped;
    for (uint64_t i = 0; i < s->waiting.records.count; i++) {
        size_t made;
        s->from = record_at(&s->waiting, i);
        const uint32_t *ids = tuple_at(&s->waiting.states, s->rebecs, s->from->at);
        enum answer answer = kernel_successors(s->kernel, ids, 1, &made, send, s);
        if (answer == UNENDING) {
            leave_unfinished(s, s->from->number);
            break;
        }
        if (answer != COMPLETE)
            return answer;
    }
    return COMPLETE;
}

/* Writes what an owner is sent; NULL without memory. */
const void *rebsync_shard_batch(struct shard *s, uint32_t owner, uint64_t *length)
{
    if (setjmp(s->escape->to))
        return NULL;
    put_batch(&s->writer, s->sent + owner, s->rebecs, s->until == NEVER ? 0 : TIMED);
    free_batch(s->sent + owner);
    *length = s->writer.bytes.count;
    return s->writer.bytes.data;
}

/* --- taking in */

/* Whether a state was seen before this level. Fingerprints are put down at once: see `receive`. */
static int is_known(struct shard *s, const uint32_t *ids)
{
    if (!s->compact)
        return find_tuple(&s->seen, s->rebecs, ids) != NONE;
    if (find_tuple(&s->fresh.states, s->rebecs, ids) != NONE)
        return 0;
    return !insert_print(s->escape, &s->prints, kernel_fingerprint(s->kernel, ids));
}

/* Takes in what another worker has sent, up to the steps of the state `end`. */
int rebsync_shard_receive(struct shard *s, const unsigned char *bytes, uint64_t end)
{
    int escaped = setjmp(s->escape->to);
    if (escaped)
        return escaped;
    s->reader.at = bytes;
    uint64_t count = take_batch(&s->reader, s->rebecs, &s->ids, &s->records);
    for (uint64_t i = 0; i < count; i++) {
        const uint32_t *ids = (uint32_t *)s->ids.data + i * s->rebecs;
        const struct record *record = (struct record *)s->records.data + i;
        if (record->parent < end && !is_known(s, ids))
            add_record(s->escape, &s->fresh, s->rebecs, ids, *record);
    }
    return COMPLETE;
}

/* Puts what is new in order. */
void rebsync_shard_settle(struct shard *s)
{
    begin_phase(s);
    s->ranked = 0;
    qsort(s->fresh.records.data, s->fresh.records.count, sizeof(struct record), compare_records);
    s->figures.fresh = s->fresh.records.count;
}

/* The ways to new states from the parents of one range, in order: there are as many ranges as workers, of
 * the numbers from `first` on that so many parents have. */
const void *rebsync_shard_ways(struct shard *s, uint64_t first, uint64_t parents, uint32_t range,
                               uint64_t *length)
{
    if (setjmp(s->escape->to))
        return NULL;
    s->writer.bytes.count = 0;
    for (uint64_t i = 0; i < s->fresh.records.count; i++) {
        const struct record *r = record_at(&s->fresh, i);
        if ((uint64_t)(((unsigned __int128)(r->parent - first) * s->shares) / parents) != range)
            continue;
        put(&s->writer, &r->parent, sizeof r->parent);
        put(&s->writer, &r->code, sizeof r->code);
    }
    *length = s->writer.bytes.count;
    return s->writer.bytes.data;
}

/* Numbers the new states whose parents are in the next range, by their places in it. */
void rebsync_shard_number(struct shard *s, uint64_t first, const uint32_t *places, uint64_t count)
{
    for (uint64_t i = 0; i < count; i++)
        record_at(&s->fresh, s->ranked++)->number = first + places[i];
}

/* --- new states */

static void judge(struct shard *s, const struct record *r)
{
    struct finding found = {0, 0, 0, r->code, 1, r->parent, (int64_t)r->number, -1};
    if (s->invariant_count)
        kernel_observe(s->kernel, tuple_at(&s->waiting.states, s->rebecs, r->at));
    for (uint32_t i = 0; i < s->invariant_count; i++, found.place++) {
        struct valuation v = kernel_evaluate(s->kernel, s->invariants[i]);
        if (v.answer != COMPLETE)
            longjmp(s->escape->to, v.answer);
        found.kind = v.defined ? PREDICATE : v.kind;
        found.pc = v.defined ? s->invariants[i] : v.pc;
        found.rebec = v.defined ? 0 : -1;
        if (!v.defined || !v.value)
            note(s, found);
    }
    found.kind = DEADLOCK;
    found.pc = found.rebec = 0;
    if (r->deadlock)
        note(s, found);
}

/* With fingerprints, leaves only local states of states that wait, now and then. */
static void collect(struct shard *s)
{
    struct tuples *t = &s->waiting.states;
    if (!s->compact || kernel_size(s->kernel) <= s->collect_at)
        return;
    size_t *first = zeroed(s->escape, s->rebecs + 1, sizeof *first);
    for (uint32_t r = 0; r < s->rebecs; r++)
        first[r + 1] = first[r] + kernel_locals(s->kernel, r);
    size_t size = first[s->rebecs] * sizeof(uint32_t);
    uint32_t *numbers = realloc(s->numbers.data, size + 1);
    if (!numbers) {
        free(first);
        give_up(s->escape);
    }
    s->numbers.data = memset(numbers, 0, size);
    for (uint64_t i = 0; i < t->count * s->rebecs; i++)
        numbers[first[i % s->rebecs] + tuple_at(t, 1, i)[0]] = 1;
    kernel_collect(s->kernel, numbers);
    for (uint64_t i = 0; i < t->count * s->rebecs; i++)
        tuple_at(t, 1, i)[0] = numbers[first[i % s->rebecs] + tuple_at(t, 1, i)[0]];
    free(first);
    s->collect_at = kernel_size(s->kernel) + kernel_size(s->kernel) / 2 + LEAST;
}

/* The fresh states, which have their numbers, are those that wait. */
static void go_deeper(struct shard *s)
{
    free_batch(&s->waiting);
    s->waiting = s->fresh;
    s->fresh = (struct batch){0};
    for (uint64_t i = 0; !s->compact && i < s->waiting.states.count; i++)
        add_tuple(s->escape, &s->seen, s->rebecs, tuple_at(&s->waiting.states, s->rebecs, i));
    free(s->waiting.states.table);
    s->waiting.states.table = NULL;
    s->waiting.states.slots = 0;
}

/* Ends a level: the fresh states are judged, and wait. */
int rebsync_shard_accept(struct shard *s)
{
    begin_phase(s);
    int escaped = setjmp(s->escape->to);
    if (escaped)
        return escaped;
    go_deeper(s);
    for (uint64_t i = 0; i < s->waiting.records.count; i++)
        judge(s, record_at(&s->waiting, i));
    collect(s);
    s->figures.states = s->waiting.records.count;
    return COMPLETE;
}

/* Writes the states that wait, as the next function reads them; NULL without memory. */
const void *rebsync_shard_checkpoint(struct shard *s, uint64_t *length)
{
    if (setjmp(s->escape->to))
        return NULL;
    put_batch(&s->writer, &s->waiting, s->rebecs, NUMBERED | (s->until == NEVER ? 0 : TIMED));
    *length = s->writer.bytes.count;
    return s->writer.bytes.data;
}

/* Takes in the states of a level that a lost worker has had; those of the last level wait. */
int rebsync_shard_restore(struct shard *s, const unsigned char *bytes)
{
    int answer = rebsync_shard_receive(s, bytes, UINT64_MAX);
    if (answer != COMPLETE)
        return answer;
    int escaped = setjmp(s->escape->to);
    if (escaped)
        return escaped;
    go_deeper(s);
    collect(s);
    return COMPLETE;
}

/* --- what it knows */

void rebsync_shard_figures(struct shard *s, struct shard_figures *figures)
{
    *figures = s->figures;
    figures->findings = s->findings.count;
}

const struct finding *rebsync_shard_findings(struct shard *s)
{
    return (struct finding *)s->findings.data;
}

void rebsync_shard_covered(struct shard *s, unsigned char *served, unsigned char *covered,
                           uint32_t *largest)
{
    kernel_covered(s->kernel, served, covered, largest);
}

/* One library, as that of a search by one machine. */
#include "kernel.c"
