/* States that are reached: counted, looked up in batches, stored, judged. */
#ifndef REBSYNC_STORING_H
#define REBSYNC_STORING_H

#include "compaction.h"
#include "outcomes.h"

/* --- what is wrong */

/* Whether an event is a violation. */
static int is_fault(const struct engine *e, const struct event *found)
{
    if (found->kind == DEADLOCK)
        return e->deadlock_is_fault;
    if (found->kind != PREDICATE)
        return 1;
    for (uint32_t i = 0; i < e->fault_count; i++)
        if (e->faults[i] == found->pc)
            return 1;
    return 0;
}

/* Notes an event unless its cause is known. */
static void note(struct engine *e, struct event found)
{
    const struct event *known = (struct event *)e->events.data;
    for (size_t i = 0; i < e->events.count; i++)
        if (known[i].kind == found.kind && known[i].pc == found.pc && known[i].rebec == found.rebec)
            return;
    *(struct event *)added(e, &e->events, sizeof found) = found;
    e->violated |= e->first && is_fault(e, &found);
}

/* The variables of a rebec as predicates read them. */
static const cell *observe(struct engine *e, uint32_t rebec, uint32_t id)
{
    struct observed *o = e->observed + rebec;
    size_t cells = e->model->rebec[rebec].cells;
    cell *at = o->variables + (id % OBSERVED) * cells;
    if (o->ids[id % OBSERVED] != id) {
        const unsigned char *from =
            (unsigned char *)e->actors[rebec].bytes.data + component(e, rebec, id)->at;
        for (size_t i = 0; i < cells; i++)
            at[i] = take_number(&from);
        o->ids[id % OBSERVED] = id;
    }
    return at;
}

static void observe_all(struct engine *e, const uint32_t *ids)
{
    for (uint32_t r = 0; r < e->rebecs; r++)
        if (e->model->observed[r])
            e->views[r] = observe(e, r, ids[r]);
}

/* Runs a predicate or measure on the state observed last; whether it has a value, which is then on
 * the stack. */
static int evaluate(struct engine *e, int32_t predicate)
{
    struct machine *m = &e->machine;
    m->covered = e->uncounted;
    m->index = -1;
    m->clock = m->elapsed = 0;
    m->depth = m->chosen = m->given = m->sent = 0;
    m->exhausted = 0;
    begin_count(e);
    start(e, e->model->predicate[predicate], NULL, 0);
    int status = e->model->run(m);
    m->covered = e->covered;
    if (m->exhausted)
        give_up(e);
    return status == DONE;
}

/* A predicate on the state observed last: 1, 0, or -1 when it has no value. */
static int holds(struct engine *e, int32_t predicate)
{
    return evaluate(e, predicate) ? e->machine.stack[0] != 0 : -1;
}

/* The extremes of a measure with the state observed last. */
static void measure(struct engine *e, int32_t number, int64_t state)
{
    struct measured *m = e->measured + number;
    if (!evaluate(e, e->model->predicates + number)) {
        m->undefined = m->undefined < 0 ? state : m->undefined;
        return;
    }
    int64_t value = e->machine.stack[0];
    if (m->least_state < 0 || value < m->least) {
        m->least = value;
        m->least_state = state;
    }
    if (m->greatest_state < 0 || value > m->greatest) {
        m->greatest = value;
        m->greatest_state = state;
    }
}

static void judge(struct engine *e, uint64_t state, const uint64_t *words, int deadlock)
{
    if (e->invariant_count || e->model->measures) {
        unpack(e, words, e->unpacked);
        observe_all(e, e->unpacked);
    }
    for (uint32_t i = 0; i < e->invariant_count; i++) {
        int truth = holds(e, e->invariants[i]);
        struct event event = {PREDICATE, e->invariants[i], 0, (int64_t)state, -1};
        if (truth < 0) {
            event.kind = e->machine.failure;
            event.pc = e->machine.pc;
            event.rebec = -1;
        }
        if (truth < 1)
            note(e, event);
    }
    for (int32_t i = 0; i < e->model->measures; i++)
        measure(e, i, (int64_t)state);
    if (deadlock)
        note(e, (struct event){DEADLOCK, 0, 0, (int64_t)state, -1});
}

/* --- batches */

static void add_state(struct engine *e, const struct pending *p, const uint64_t *words)
{
    uint64_t state = e->count, place = state - e->forgotten;
    size_t size = e->words * sizeof *words;
    memcpy((char *)room_for(e, &e->states, (place + 1) * size, 1) + place * size, words, size);
    if (e->compact)
        write_step(e, (struct step){e->purpose == START ? NONE : p->parent, p->code});
    else
        *(uint32_t *)added(e, &e->parents, sizeof(uint32_t)) = p->parent;
    if (e->until != NEVER)
        *(int64_t *)added(e, &e->times, sizeof(int64_t)) = p->time;
    e->count++;
    judge(e, state, words, p->deadlock);
}

static void settle(struct engine *e, const struct pending *p, const uint64_t *words)
{
    if (p->event >= 0) {
        note(e, e->failed[p->event]);
        return;
    }
    room_for_state(e);
    if (e->compact) {
        if (!is_new_print(e, p->hash))
            return;
    } else {
        uint64_t at = find(e, words, p->hash);
        if (e->table[at])
            return;
        e->table[at] = tag_of(e, p->hash) | (uint32_t)(e->count + 1);
    }
    add_state(e, p, words);
}

/* Looks up and stores what has gathered, in its order. */
static void flush(struct engine *e)
{
    uint32_t count = e->pending;
    e->pending = 0;
    for (uint32_t i = 0; i < count; i++) {
        settle(e, e->batch + i, e->batch_words + (size_t)i * e->words);
        if (!e->violated)
            continue;
        e->transitions -= e->purpose == SEARCH ? count - i - 1 : 0;
        longjmp(e->escape, VIOLATED);
    }
}

static struct pending *gather(struct engine *e, uint64_t code)
{
    if (code > UINT32_MAX)
        give_up(e);
    if (e->pending == BATCH)
        flush(e);
    if (e->wide) {
        flush(e);
        repack(e);
    }
    struct pending *p = e->batch + e->pending;
    p->parent = e->purpose == START ? (uint32_t)code : (uint32_t)e->current;
    p->code = (uint32_t)code;
    p->event = -1;
    e->transitions += e->purpose == SEARCH;
    return p;
}

/* The state e->next has been reached by the step of a code. */
static void store(struct engine *e, uint64_t code, int64_t time, int deadlock)
{
    if (e->until != NEVER) {
        time += e->purpose == START ? 0 : ((int64_t *)e->times.data)[e->current - e->forgotten];
        if (time > e->until) {
            e->dropped++;
            return;
        }
    }
    struct pending *p = gather(e, code);
    uint64_t *words = e->batch_words + (size_t)e->pending++ * e->words;
    pack(e, e->next, words);
    p->time = time;
    p->deadlock = deadlock;
    if (e->compact) {
        p->hash = print_of(e, e->next);
        prefetch_print(e, p->hash);
    } else {
        p->hash = hash_words(e, words);
        if (e->slots)
            __builtin_prefetch(e->table + slot_of(e, p->hash), 1);
    }
}

static void store_failure(struct engine *e, uint64_t ordinal, int32_t kind, int32_t pc, int32_t rebec)
{
    struct pending *p = gather(e, ordinal);
    int64_t state = e->purpose == START ? -1 : (int64_t)e->current;
    e->failed[e->pending] = (struct event){kind, pc, rebec, state, (int64_t)ordinal};
    p->event = (int32_t)e->pending++;
}

#endif
