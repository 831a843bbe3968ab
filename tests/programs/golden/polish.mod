%%%
  VERSION:1
  LANGUAGE:ENGLISH
%%%
MODULE Polish
  ! Targets of the polishing cell
  CONST jointtarget jHome:=[[0,-20.5,15,0,90,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  LOCAL PERS jointtarget jPath{2}:=[[[10.25,-15,20,5,75.123456789,30],[1250.5,9E+09,9E+09,9E+09,9E+09,9E+09]],
    [[12.5,-14,19.5,4.5,76,29],[1250.5,9E+09,9E+09,9E+09,9E+09,9E+09]]];
  VAR jointtarget jCalc:=[[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget pTop:=[[600,0,800],[0,0.7071068,0.7071068,0],[0,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    MoveAbsJ jHome\NoEOffs,v1000,z50,tool0;
    MoveL pTop,v500,fine,tBelt\WObj:=wPart; ! a ""pose""
    FOR i FROM 1 TO 2 DO
      MoveAbsJ jPath{i},v200,z5,tBelt;
    ENDFOR
    jCalc.robax.rax_6:=jCalc.robax.rax_6+5;
    MoveAbsJ jCalc,v200,fine,tBelt;
    MoveAbsJ [[-35.5,10,12,-170,60,1.5E1],[9E9,9E9,9E9,9E9,9E9,9E9]]\NoEOffs,v1000,fine,tool0;
    MoveAbsJ CalcJointT(pTop,tBelt),v200,fine,tBelt;
    TPWrite "MoveAbsJ [[0,0,0,0,0,0],[0,0,0,0,0,0]] ""text""";
  ENDPROC
ENDMODULE
