/* The twin of untimed.rebeca. It has one state more: before init has started the others. */
#ifndef LAPS
#define LAPS 2
#endif

#define WORKERS 4
#define NO 0
#define YES 1
#define REST 2
#define LEAVE 0	/* other numbers ask for so many places */

chan worker[WORKERS] = [3] of { byte };
chan controller = [10] of { byte, byte };

/* of one step only, so no part of a state */
hidden byte who;
hidden byte what;

proctype Worker(byte me)
{
	byte lap;

	do
	:: atomic { worker[me] ? REST ->
		assert(nfull(controller));
		if
		:: controller ! me, 1
		:: controller ! me, 2
		fi }
	:: atomic { worker[me] ? NO ->
		assert(nfull(worker[me]));
		worker[me] ! REST }
	:: atomic { worker[me] ? YES ->
		lap++;
		if
		:: lap >= LAPS -> lap = 0
		:: else
		fi;
		assert(nfull(controller));
		controller ! me, LEAVE;
		assert(nfull(worker[me]));
		worker[me] ! REST }
	od
}

proctype Controller()
{
	byte inside;

	do
	:: atomic { controller ? who, what ->
		if
		:: what == LEAVE -> inside--
		:: else ->
			assert(nfull(worker[who]));
			if
			:: inside + what <= 3 -> inside++; worker[who] ! YES
			:: else -> worker[who] ! NO
			fi
		fi;
		who = 0; what = 0 }
	od
}

init {
	byte i;
	atomic {
		for (i : 0 .. WORKERS - 1) {
			worker[i] ! REST;
			run Worker(i)
		}
		i = 0;
		run Controller()
	}
}
